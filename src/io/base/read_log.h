/// Log of the files read and their contents.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

struct XXH3_state_s;

namespace vorpipe {

/// Number of bytes and their 128-bit XXH3 hash, as `xxh128sum` prints it.
struct Contents {
  std::uint64_t bytes = 0;
  std::string xxh128;
  friend bool operator==(const Contents&, const Contents&) = default;
};

/// Hashes bytes that come in pieces.
class ContentHash {
 public:
  ContentHash();
  void add(std::string_view bytes);
  /// Contents of all bytes added so far.
  [[nodiscard]] Contents contents() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
  std::uint64_t bytes_ = 0;
};

/// Reads a whole file; does not inflate gzip. Errors: those of InputFile.
Result<Contents> contentsOf(const std::string& path);

struct LoggedFile {
  std::string path;  ///< as it was given; "-" is standard input
  Contents contents;
};

/// During its lifetime, notes what InputFile opens on this thread, so that readers need not pass it on. A log
/// made later takes over for its own lifetime.
class ReadLog {
 public:
  /// What to note: hashing contents takes time.
  enum class Notes : std::uint8_t { names, contents };
  explicit ReadLog(Notes notes = Notes::contents);
  ~ReadLog();
  ReadLog(const ReadLog&) = delete;
  ReadLog& operator=(const ReadLog&) = delete;

  /// Returns the log of this thread's reads; null if there is none.
  static ReadLog* current();

  /// Nothing is noted during its lifetime.
  class Pause {
   public:
    Pause();
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    ReadLog* log_;
  };

  /// Notes an opened file. Hashes the present contents of a file that can be read again; leaves out one that
  /// cannot be read, since its reader reports why. If `is_stream`, it can be read only once: the reader adds
  /// every byte to the returned hash, if there is one.
  std::shared_ptr<ContentHash> note(const std::string& path, const struct stat& status, bool is_stream);

  /// Returns the noted contents in the order of opening; a file opened twice appears once.
  [[nodiscard]] std::vector<LoggedFile> files() const;
  /// Returns the name under which the regular file at `path` was opened; null if it was not.
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
