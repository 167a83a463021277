/// Parses JSON while reading it: one text, or one per line. Including this header compiles the parser.
#pragma once

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/input_file.h"
#include "io/base/line_reader.h"
#include "io/base/number.h"

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

  /// Returns "NAME:LINE:COLUMN: what" as an input error about the byte `back` before the last, or about the
  /// number read last.
  [[nodiscard]] tl::unexpected<Error> errorAt(std::size_t back, std::string_view what) const;
  [[nodiscard]] tl::unexpected<Error> errorAtNumber(std::string_view what) const;

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Number of bytes taken; as in the parser, the end counts as one.
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Why the text was stopped.
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

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
  std::optional<Error> error_;
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

 private:
  JsonBytes* bytes_;
};

/// Items of JSON that is kept as a whole.
struct NoItems {
  [[nodiscard]] bool isList(std::string_view /*member*/) const { return false; }
  template <class Json>
  void take(const Json& /*item*/) {}
};

/// Builds values from the parser's events, in the order of the text. `Items` names members of the top object
/// that are lists. It gets each of their items once complete; they are not kept. Stops the text if lists and
/// objects nest too deep or an object has too many members: the parser may compare each with all before it.
/// (The parser's own callback would look at all of a list's items at the end of each.)
template <class Json, class Items>
class JsonBuilder {
 public:
  JsonBuilder(JsonBytes& bytes, Items& items) : bytes_(bytes), items_(items), top_builder_(top_) {}

  // Called by nlohmann::json's parser, which requires these names; false ends parsing.
  bool null() { return single(&Values::null); }
  bool boolean(bool value) { return single(&Values::boolean, value); }
  bool number_integer(typename Json::number_integer_t value) {
    return single(&Values::number_integer, value);
  }
  bool number_unsigned(typename Json::number_unsigned_t value) {
    return single(&Values::number_unsigned, value);
  }
  bool number_float(typename Json::number_float_t value, const std::string& text) {
    return single(&Values::number_float, value, text);
  }
  bool string(std::string& value) { return single(&Values::string, value); }
  bool binary(typename Json::binary_t& value) { return single(&Values::binary, value); }
  bool start_object(std::size_t size) {
    if (!beginsItem()) return false;
    members_[depth_] = 0;
    return begin() && values().start_object(size);
  }
  bool start_array(std::size_t size) {
    if (!beginsItem()) return false;
    in_list_ = in_list_ || (depth_ == 1 && of_object_ && items_.isList(member_));
    return begin() && values().start_array(size);
  }
  bool key(std::string& name) {
    if (++members_[depth_ - 1] > most_members) {
      return stop(fmt::format("an object has more than {} members", most_members));
    }
    if (depth_ == 1) {
      of_object_ = true;
      member_ = name;
    }
    return values().key(name);
  }
  bool end_object() { return values().end_object() && end(); }
  bool end_array() { return values().end_array() && end(); }
  bool parse_error(std::size_t byte, const std::string& /*token*/, const nlohmann::detail::exception& error) {
    constexpr int out_of_range = 406;
    if (bytes_.error()) return false;
    bytes_.stop(error.id == out_of_range ? bytes_.errorAtNumber("the number is too large for a double")
                                         : bytes_.errorAt(bytes_.count() - byte, "is no JSON from here on"));
    return false;
  }

  /// The value without the items passed on.
  Json& top() { return top_; }

 private:
  using Values = nlohmann::detail::json_sax_dom_parser<Json>;

  static constexpr std::size_t deepest = 200, most_members = 2000;
  /// Number of lists and objects around an item.
  static constexpr std::size_t depth_of_items = 2;

  Values& values() { return item_builder_ ? *item_builder_ : top_builder_; }

  bool stop(std::string_view what) {
    bytes_.stop(bytes_.errorAt(0, what));
    return false;
  }

  bool beginsItem() {
    if (!in_list_ || depth_ != depth_of_items || item_builder_) return true;
    item_ = Json();
    item_builder_.emplace(item_);
    return true;
  }
  bool endsItem() {
    if (!item_builder_ || depth_ != depth_of_items) return true;
    item_builder_.reset();
    bytes_.forget();
    items_.take(std::as_const(item_));
    return !bytes_.error();
  }
  template <class Add, class... Value>
  bool single(Add add, Value&... value) {
    return beginsItem() && (values().*add)(value...) && endsItem();
  }
  bool begin() {
    if (++depth_ <= deepest) return true;
    return stop(fmt::format("stands in more than {} lists and objects", deepest));
  }
  bool end() {
    --depth_;
    if (depth_ < depth_of_items) in_list_ = false;
    return endsItem();
  }

  JsonBytes& bytes_;
  Items& items_;
  Json top_, item_;
  Values top_builder_;
  std::optional<Values> item_builder_;              ///< while there is an item
  std::size_t depth_ = 0;                           ///< lists and objects around the next value
  std::array<std::size_t, deepest + 1> members_{};  ///< by depth: count for the object begun last
  bool of_object_ = false, in_list_ = false;
  std::string member_;  ///< of the top object
};

/// Parses one JSON text. Errors: it is no JSON, with its place (input); those of reading; the error that
/// stopped it.
template <class Json, class Items>
Result<Json> parseJson(JsonBytes& bytes, Items& items) {
  JsonBuilder<Json, Items> builder(bytes, items);
  const bool whole = Json::sax_parse(JsonIterator(&bytes), JsonIterator(&bytes), &builder);
  if (whole && !bytes.error()) return std::move(builder.top());
  return tl::unexpected(*bytes.error());
}
template <class Json>
Result<Json> parseJson(JsonBytes& bytes) {
  NoItems none;
  return parseJson<Json>(bytes, none);
}

/// Returns the JSON of a line, without the separator that RFC 8142 puts before it.
inline std::string_view withoutSeparator(std::string_view line) {
  line = trimmed(line);
  return line.starts_with('\x1E') ? trimmed(line.substr(1)) : line;
}

/// Calls take(value) for each nonblank line. take returns what is wrong with the value, if anything; the
/// error puts the line's place before it. Errors: those of reading and parsing (input, device).
template <class Json, class Take>
Result<void> eachJsonLine(LineReader& lines, const Take& take) {
  while (true) {
    VORPIPE_LET(line, lines.next());
    if (!line) return {};
    const std::string_view text = withoutSeparator(*line);
    if (text.empty()) continue;
    JsonBytes bytes(lines.name(), text);
    bytes.setPlace(lines.number(), static_cast<std::size_t>(text.data() - line->data()));
    VORPIPE_LET(value, parseJson<Json>(bytes));
    if (const auto problem = take(value)) {
      return inputError(fmt::format("{}:{}: {}", lines.name(), lines.number(), *problem));
    }
  }
}

}  // namespace vorpipe
