/// Parses JSON while reading it. Including this header compiles the parser.
#pragma once

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "io/base/json_bytes.h"

namespace vorpipe {

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
  bool null() {
    return single([](Values& to) { return to.null(); });
  }
  bool boolean(bool value) {
    return single([=](Values& to) { return to.boolean(value); });
  }
  bool number_integer(typename Json::number_integer_t value) {
    return single([=](Values& to) { return to.number_integer(value); });
  }
  bool number_unsigned(typename Json::number_unsigned_t value) {
    return single([=](Values& to) { return to.number_unsigned(value); });
  }
  bool number_float(typename Json::number_float_t value, const std::string& text) {
    return single([&](Values& to) { return to.number_float(value, text); });
  }
  bool string(std::string& value) {
    return single([&](Values& to) { return to.string(value); });
  }
  bool binary(typename Json::binary_t& value) {
    return single([&](Values& to) { return to.binary(value); });
  }
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
    return !bytes_.stopped();
  }
  template <class Add>
  bool single(const Add& add) {
    return beginsItem() && add(values()) && endsItem();
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

}  // namespace vorpipe
