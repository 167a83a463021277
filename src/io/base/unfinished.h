/// Unfinished files, which are removed when the process is told to end.
#pragma once

#include <string>

namespace vorpipe {

struct UnfinishedSlot;

/// A new file, removed with this object, or earlier by removeUnfinished(), unless it was moved away.
class Unfinished {
 public:
  /// create() makes the file, but removeUnfinished() has the path from here on: it never misses an existing
  /// file.
  explicit Unfinished(std::string path);
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished();

  /// Creates the file, which must not exist. Returns its descriptor, or -1 with errno set.
  int create(unsigned mode);
  /// Makes the file another name of an old one. Returns false with errno set on failure.
  bool linkTo(const char* old);
  /// Renames the file, which then stays. Returns false with errno set on failure.
  bool moveTo(const char* target);

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  UnfinishedSlot* slot_;
  bool is_there_ = false;
};

/// Removes all unfinished files of all threads. For signal handlers: it makes only async-signal-safe calls.
/// They must then end the process, since threads with such a file wait for that.
void removeUnfinished();

}  // namespace vorpipe
