/// Which files are read, and what is in them.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/base/content_hash.h"

namespace vorpipe {

struct LoggedFile {
  std::string path;  ///< as it was given; "-" is standard input
  Contents contents;
};

/// While one lives, it notes what InputFile opens on this thread, so that readers need not pass it on. One
/// that is made later takes over until it is gone.
class ReadLog {
 public:
  /// To hash files takes time.
  enum class Notes : std::uint8_t { names, contents };
  explicit ReadLog(Notes notes = Notes::contents);
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

  /// Notes what was opened. Of a file that stays where it is contents are those that it has now; one that
  /// cannot be read is left out: its reader says why. Where what `is_stream` can be read only once, the
  /// reader adds every byte to the hash that is returned, if there is one.
  std::shared_ptr<ContentHash> note(const std::string& path, const struct stat& status, bool is_stream);

  /// Contents that were noted, in the order in which they were opened; a file that was opened twice stands
  /// once.
  [[nodiscard]] std::vector<LoggedFile> files() const;
  /// The name by which a regular file was opened that is the one `path` leads to; null: none was.
  [[nodiscard]] const std::string* nameOf(const std::string& path) const;

 private:
  struct Entry {
    std::string path;
    Contents contents;
    std::shared_ptr<ContentHash> stream;  ///< none: the contents are known
  };
  struct File {
    std::string path;
    dev_t device;
    ino_t number;
  };
  Notes notes_;
  std::vector<Entry> entries_;
  std::vector<File> opened_;
  ReadLog* before_;
};

}  // namespace vorpipe
