/// Files that others take the place of.
#pragma once

#include <sys/stat.h>

#include <memory>
#include <string>
#include <string_view>

#include "io/base/unfinished.h"

namespace vorpipe {

/// Why a file that exists cannot be replaced; empty: it can.
std::string whyNotReplaced(const std::string& file, const struct stat& status);

/// A path in the folder of `target` that no other call gets.
std::string pathBeside(const std::string& target);

/// Whether a file of this name, without its folder, is one that a process which was killed may have left:
/// ".vorpipe-1234-0.tmp".
bool isLeftOver(std::string_view name);

/// A file that is about to be replaced, which keeps another name until the end of this object's life, where
/// the file system has links.
class ReplacedFile {
 public:
  /// Of a path where there may be no file as well.
  explicit ReplacedFile(std::string path);

  /// Makes the path lead to what it did: to no file, where there was none.
  void putBack();

 private:
  std::string path_;
  std::unique_ptr<Unfinished> kept_;
  bool was_there_;
};

}  // namespace vorpipe
