/// Files that others replace.
#pragma once

#include <sys/stat.h>

#include <memory>
#include <string>
#include <string_view>

#include "io/base/unfinished.h"

namespace vorpipe {

/// Returns why an existing file cannot be replaced; empty if it can.
std::string whyNotReplaced(const std::string& file, const struct stat& status);

/// Returns a path in the folder of `target` that no other call returns.
std::string pathBeside(const std::string& target);

/// Whether a killed process may have left a file of this name, given without its folder:
/// ".vorpipe-1234-0.tmp".
bool isLeftOver(std::string_view name);

/// A file about to be replaced. It keeps a second name during this object's lifetime, if the file system has
/// links.
class ReplacedFile {
 public:
  /// There need not be a file at the path.
  explicit ReplacedFile(std::string path);

  /// Restores what was at the path: no file if there was none.
  void putBack();

 private:
  std::string path_;
  std::unique_ptr<Unfinished> kept_;
  bool was_there_;
};

}  // namespace vorpipe
