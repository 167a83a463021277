/// Text, line by line, through a buffer of fixed size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/base/input_file.h"

namespace vorpipe {

/// Returns a file's text without its UTF-8 byte order mark, if there is one.
std::string_view withoutByteOrderMark(std::string_view text);

class LineReader {
 public:
  static constexpr std::size_t longest_line = std::size_t{1} << 20;  ///< bytes

  explicit LineReader(InputFile file);

  /// The next line without its end (LF, CR LF or CR) and, in the first line, without a UTF-8 byte
  /// order mark; valid until the next call. None after the last line. Errors: a line is longer than
  /// longest_line (input), reading failed (device).
  Result<std::optional<std::string_view>> next();

  /// The lines in the buffer that end with LF, their ends included; reads more of the file if there is no
  /// such line. Empty at the end of the file, and if a line is longer than the buffer. Error (device):
  /// reading failed.
  Result<std::string_view> wholeLines();
  /// Consumes the first `bytes` bytes, which are `lines` lines, of what wholeLines() returned last.
  void skip(std::size_t bytes, std::uint64_t lines);

  /// Number of the line that next() returned last, counted from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  [[nodiscard]] const std::string& name() const { return file_.name(); }

  /// "FILE:LINE:COLUMN: what" as an input error about a byte of the last line, columns from 1.
  [[nodiscard]] tl::unexpected<Error> errorAt(std::size_t column, std::string_view what) const;

 private:
  Result<void> refill();
  std::optional<std::string_view> takeUntil(const char* end);

  InputFile file_;
  std::unique_ptr<char[]> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::uint64_t number_ = 0;
  bool at_end_ = false;
};

}  // namespace vorpipe
