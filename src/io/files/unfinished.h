/// Files that are not finished, of which nothing stays when the process is told to end.
#pragma once

#include <string>

namespace vorpipe {

struct UnfinishedSlot;

/// A file that is removed at the end of this object's life, or before it by removeUnfinished(), unless it was
/// moved away.
class Unfinished {
 public:
  explicit Unfinished(std::string path);
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished();

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Renames the file, which is to stay then; whether that was done, else errno says why not.
  bool moveTo(const char* target);

 private:
  void wasMoved();

  std::string path_;
  UnfinishedSlot* slot_;
};

/// Removes all that there are, of all threads. For handlers of signals, which must end the process then,
/// since threads that have such a file wait for that: it makes async-signal-safe calls alone.
void removeUnfinished();

}  // namespace vorpipe
