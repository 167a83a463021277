/// A file, or standard input, that is read once from its beginning to its end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

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
  /// system could not read.
  Result<std::size_t> read(std::span<char> bytes);

  /// Size in bytes; none where it is not known beforehand (a pipe, a terminal).
  [[nodiscard]] std::optional<std::uint64_t> size() const { return size_; }
  /// The path as it was given, for messages; "<stdin>" for standard input.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  InputFile(int descriptor, std::string name, std::optional<std::uint64_t> size);
  int descriptor_;
  std::string name_;
  std::optional<std::uint64_t> size_;
  std::shared_ptr<ContentHash> hash_;  ///< of a stream that a ReadLog notes
};

}  // namespace vorpipe
