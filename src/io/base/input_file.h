/// A file, or standard input, that is read once from its beginning to its end; gzip is inflated on the way.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe {

class ContentHash;

/// One deflated byte inflates to at most this many.
inline constexpr std::uint64_t largest_inflation = 1032;

class InputFile {
 public:
  /// Opens `path` for reading; "-" is standard input. Errors (input): it is missing, a directory or
  /// not readable.
  static Result<InputFile> open(const std::string& path);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  /// Fills `bytes` unless the file ends first; returns the number of bytes read. Inflates a file that begins
  /// as gzip does. Errors: the system could not read (device); gzip data are damaged or end too early
  /// (input).
  Result<std::size_t> read(std::span<char> bytes);
  /// The same for the bytes as stored, whether gzip or not. Call either this or read.
  Result<std::size_t> readAsIs(std::span<char> bytes);

  /// Size in bytes; none if unknown beforehand (a pipe, a terminal, and gzip once it is read).
  [[nodiscard]] std::optional<std::uint64_t> size() const { return size_; }
  /// Upper bound on the bytes that a file holds, even if packed; none if its own size is unknown beforehand.
  [[nodiscard]] std::optional<std::uint64_t> mostBytes() const;
  /// The path as it was given, for messages; "<stdin>" for standard input.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  /// Closes itself, unless it is standard input.
  struct Descriptor {
    int number;
    explicit Descriptor(int opened) : number(opened) {}
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&& other) noexcept;
    ~Descriptor();
  };
  struct Inflater;

  InputFile(int descriptor, std::string name);
  Result<void> begin();
  Result<std::size_t> readBytes(std::span<char> bytes);
  Result<std::size_t> inflate(std::span<char> bytes);

  Descriptor descriptor_;
  std::string name_;
  std::optional<std::uint64_t> size_, stored_size_;  ///< stored_size_: before gzip is inflated
  bool begun_ = false;
  std::array<char, 2> head_{};  ///< the first bytes, which identify gzip
  std::size_t head_begin_ = 0, head_end_ = 0;
  std::unique_ptr<Inflater> inflater_;
  std::shared_ptr<ContentHash> hash_;  ///< of a stream noted by a ReadLog
};

/// Returns the rest of a file. Errors: those of reading; more than `most` bytes, or more than memory holds
/// (input).
Result<std::string> readText(InputFile& file, std::size_t most = std::string::npos);

/// Checks before allocation. Error (input): `bytes` is more than this process may allocate; "NAME: its WHAT
/// need about ...".
Result<void> checkRoom(std::string_view name, std::string_view what, std::uint64_t bytes);

}  // namespace vorpipe
