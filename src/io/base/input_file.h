/// A file, or standard input, that is read once from its beginning to its end; gzip is inflated on the way.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/base/inflater.h"
#include "vorpipe.h"

namespace vorpipe {

class ContentHash;

class InputFile {
 public:
  /// Opens `path` for reading; "-" is standard input. Errors (input): it is missing, a directory or
  /// not readable.
  static Result<InputFile> open(const std::string& path);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  /// Fills `bytes` unless the file ends first; returns how many bytes it has read. Error (device): the
  /// system could not read. Of a file that begins as gzip does, the bytes are those that were packed; error
  /// (input): they are damaged or end too early.
  Result<std::size_t> read(std::span<char> bytes);
  /// The same of the bytes that stand in the file, whether gzip or not. Either this or read is called.
  Result<std::size_t> readAsIs(std::span<char> bytes);

  /// Size in bytes; none where it is not known beforehand (a pipe, a terminal, and gzip once it is read).
  [[nodiscard]] std::optional<std::uint64_t> size() const { return size_; }
  /// More bytes than a file can hold, which may be packed; none where its own size is not known beforehand.
  [[nodiscard]] std::optional<std::uint64_t> mostBytes() const;
  /// The path as it was given, for messages; "<stdin>" for standard input.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  InputFile(int descriptor, std::string name, std::optional<std::uint64_t> size);
  Result<void> begin();
  Result<std::size_t> readBytes(std::span<char> bytes);

  int descriptor_;
  std::string name_;
  std::optional<std::uint64_t> size_, stored_size_;  ///< stored_size_: of gzip as it is
  bool begun_ = false;
  std::array<char, 2> head_{};  ///< the first bytes, which tell gzip
  std::size_t head_begin_ = 0, head_end_ = 0;
  std::optional<Inflater> inflater_;
  std::shared_ptr<ContentHash> hash_;  ///< of a stream that a ReadLog notes
};

/// All that is left of a file. Errors: those of reading; (input) there are more than `most` bytes, or than
/// memory holds.
Result<std::string> readText(InputFile& file, std::size_t most = std::string::npos);

}  // namespace vorpipe
