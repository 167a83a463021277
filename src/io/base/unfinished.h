/// Files that are not finished, of which nothing stays when the process is told to end.
#pragma once

#include <string>

namespace vorpipe {

struct UnfinishedSlot;

/// A new file, which is removed at the end of this object's life, or before it by removeUnfinished(), unless
/// it was moved away.
class Unfinished {
 public:
  /// There is none before create(); but the path is known to removeUnfinished() from here on, so that no
  /// moment is left in which there is a file that it does not know.
  explicit Unfinished(std::string path);
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished();

  /// A descriptor of the file, which did not exist before; or -1, and errno says why not.
  int create(unsigned mode);
  /// Makes the file another name of an old one; whether that was done, else errno says why not.
  bool linkTo(const char* old);
  /// Renames the file, which is to stay then; whether that was done, else errno says why not.
  bool moveTo(const char* target);

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  UnfinishedSlot* slot_;
  bool is_there_ = false;
};

/// Removes all that there are, of all threads. For handlers of signals, which must end the process then,
/// since threads that have such a file wait for that: it makes async-signal-safe calls alone.
void removeUnfinished();

}  // namespace vorpipe
