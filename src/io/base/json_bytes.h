/// Bytes of JSON that is parsed while it is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/base/error.h"
#include "io/base/input_file.h"

namespace vorpipe {

/// Bytes of a text, one by one, with the line and column of the last one.
class JsonBytes {
 public:
  /// `name` begins error messages; for a file, its own name does.
  JsonBytes(std::string name, std::string_view text)
      : name_(std::move(name)), next_(text.data()), end_(text.data() + text.size()) {}
  explicit JsonBytes(InputFile& file) : name_(file.name()), file_(&file), buffer_(chunk) {}

  /// Sets the line of the first byte, and the number of bytes before it on that line.
  void setPlace(std::uint64_t line, std::uint64_t before) {
    line_ = line;
    before_ = before;
  }

  /// Whether all bytes were taken or stop() was called.
  bool atEnd() { return next_ == end_ && !refill(); }
  /// The next byte; call only before the end.
  [[nodiscard]] char next() const { return *next_; }
  void take() {
    const char c = *next_++;
    count(c);
    const bool in_number = isInNumbers(c);
    if (in_number && !in_number_) {
      number_line_ = line_;
      number_column_ = column();
    }
    in_number_ = in_number;
    // The parser takes this byte for the end, whatever follows.
    if (c == '\0') stop(errorAt(0, "is no JSON from here on: a byte is 0"));
  }

  /// Notes that the parsed text so far is not kept: what follows may take as much memory again.
  void forget() { kept_from_ = count_; }

  /// Ends the text here: the parser then fails, and parseJson returns this error.
  void stop(tl::unexpected<Error> error);
  [[nodiscard]] bool stopped() const { return stopped_.has_value(); }

  /// Returns "NAME:LINE:COLUMN: what" as an input error about the byte `back` before the last, or about the
  /// number read last.
  [[nodiscard]] tl::unexpected<Error> errorAt(std::size_t back, std::string_view what) const;
  [[nodiscard]] tl::unexpected<Error> errorAtNumber(std::string_view what) const;

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Number of bytes taken; as in the parser, the end counts as one.
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] const std::optional<Error>& error() const { return stopped_; }

 private:
  static constexpr std::size_t chunk = std::size_t{1} << 16;

  static bool isInNumbers(char c) {
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
  }
  void count(char c) {
    if (last_ == '\n') {
      ++line_;
      before_ = 0;
      line_begin_ = count_;
    }
    ++count_;
    last_ = c;
  }
  /// Column of the last byte.
  [[nodiscard]] std::uint64_t column() const { return before_ + count_ - line_begin_; }
  bool refill();
  void checkKept();

  std::string name_;
  InputFile* file_ = nullptr;
  std::vector<char> buffer_;
  const char* next_ = nullptr;
  const char* end_ = nullptr;
  std::uint64_t count_ = 0, line_ = 1, before_ = 0, line_begin_ = 0;
  std::uint64_t kept_from_ = 0;  ///< count_ at the start of what the parser keeps
  std::uint64_t number_line_ = 1, number_column_ = 1;
  char last_ = ' ';
  bool in_number_ = false, at_end_ = false;
  std::optional<Error> stopped_;
};

/// Iterator over JsonBytes for the parser.
class JsonIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  explicit JsonIterator(JsonBytes* bytes) : bytes_(bytes) {}
  char operator*() const { return bytes_->next(); }
  JsonIterator& operator++() {
    bytes_->take();
    return *this;
  }
  /// The other one is the end.
  bool operator==(const JsonIterator& /*end*/) const { return bytes_->atEnd(); }
  bool operator!=(const JsonIterator& end) const { return !(*this == end); }

 private:
  JsonBytes* bytes_;
};

}  // namespace vorpipe
