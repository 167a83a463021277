/// JSON that is parsed while it is read. What includes this compiles the parser.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "io/files/error.h"
#include "io/files/input_file.h"

namespace vorpipe {

/// The bytes of a text, one by one, and the line and column of the last.
class JsonBytes {
 public:
  /// `name` begins errors; of a file, its own does.
  JsonBytes(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {}
  explicit JsonBytes(InputFile& file) : name_(file.name()), file_(&file), buffer_(chunk) {}

  /// The next byte; none at the end, and once it is to stop.
  [[nodiscard]] std::optional<char> peek();
  void take();

  /// The line of the first byte, and how many bytes stand before it there.
  void setPlace(std::uint64_t line, std::uint64_t before) { last_ = {line, before}; }

  /// Ends the text here: the parser then fails, and parseJson returns this error.
  void stop(tl::unexpected<Error> error) { stopped_ = std::move(error.value()); }
  [[nodiscard]] bool stopped() const { return stopped_.has_value(); }

  /// "NAME:LINE:COLUMN: what", as an input error, about the last byte but `back`, or about the number that
  /// was read last.
  [[nodiscard]] tl::unexpected<Error> errorAt(std::size_t back, std::string_view what) const;
  [[nodiscard]] tl::unexpected<Error> errorAtNumber(std::string_view what) const;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] const std::optional<Error>& error() const { return stopped_; }

 private:
  static constexpr std::size_t chunk = std::size_t{1} << 16;
  struct Place {
    std::uint64_t line = 1, column = 0;
  };
  bool refill();

  std::string name_;
  InputFile* file_ = nullptr;
  std::vector<char> buffer_;
  std::string_view rest_;
  std::uint64_t count_ = 0;  ///< bytes that were taken, and the end
  Place last_, number_;
  bool after_line_end_ = false, in_number_ = false, at_end_ = false;
  std::optional<Error> stopped_;
};

/// For the parser, which takes iterators.
class JsonIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  explicit JsonIterator(JsonBytes* bytes) : bytes_(bytes) {}
  char operator*() const { return *bytes_->peek(); }
  JsonIterator& operator++() {
    bytes_->take();
    return *this;
  }
  /// The other one is the end.
  bool operator==(const JsonIterator& /*end*/) const { return !bytes_->peek(); }
  bool operator!=(const JsonIterator& end) const { return !(*this == end); }

 private:
  JsonBytes* bytes_;
};

/// Parses one JSON text; `callback` as the parser's own, null for none. Errors: it is no JSON, with its place
/// (input); those of reading; what stopped it.
template <class Json>
Result<Json> parseJson(JsonBytes& bytes, const typename Json::parser_callback_t& callback = nullptr) {
  try {
    Json value = Json::parse(JsonIterator(&bytes), JsonIterator(&bytes), callback);
    if (!bytes.error()) return value;
  } catch (const typename Json::parse_error& error) {
    if (!bytes.error()) return bytes.errorAt(bytes.count() - error.byte, "is no JSON from here on");
  } catch (const typename Json::out_of_range&) {
    if (!bytes.error()) return bytes.errorAtNumber("the number is too large for a double");
  }
  return tl::unexpected(*bytes.error());
}

}  // namespace vorpipe
