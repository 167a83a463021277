/// Which files are read, and what is in them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/files/content_hash.h"

namespace vorpipe {

struct LoggedFile {
  std::string path;  ///< as it was given; "-" is standard input
  Contents contents;
};

/// While one lives, it notes what InputFile opens on this thread, so that readers need not pass it on. One
/// that is made later takes over until it is gone.
class ReadLog {
 public:
  ReadLog();
  ~ReadLog();
  ReadLog(const ReadLog&) = delete;
  ReadLog& operator=(const ReadLog&) = delete;

  /// The log that notes what this thread reads; null if there is no log on this thread.
  static ReadLog* current();

  /// While it lives, nothing is noted.
  class Pause {
   public:
    Pause();
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    ReadLog* log_;
  };

  /// Notes a file that stays where it is, with what is in it now. One that cannot be read is left out: its
  /// reader says why.
  void note(const std::string& path);
  /// Notes what can be read only once: the reader adds every byte to the hash.
  std::shared_ptr<ContentHash> noteStream(const std::string& path);

  /// What was noted, in the order in which it was opened; a file that was opened twice stands once.
  [[nodiscard]] std::vector<LoggedFile> files() const;

 private:
  struct Entry {
    std::string path;
    Contents contents;
    std::shared_ptr<ContentHash> stream;  ///< none: the contents are known
  };
  std::vector<Entry> entries_;
  ReadLog* before_;
};

}  // namespace vorpipe
