/// What an input says of its sites besides their places and weights: names, codes, figures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorpipe {

/// How the values of an attribute read.
enum class AttributeType : std::uint8_t {
  integer,  ///< as JSON has them, within 64 bits with a sign
  real,     ///< numbers as JSON has them
  boolean,  ///< true, false
  text,     ///< UTF-8
  json,     ///< any JSON, lists and objects among them
};

/// One value for each site, in their order; a value may be missing. Values are kept as text, so that what
/// comes out is what went in: `007` stays text, and a number keeps its digits.
class Attribute {
 public:
  explicit Attribute(std::string name, AttributeType type = AttributeType::text)
      : name_(std::move(name)), type_(type) {}

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] AttributeType type() const { return type_; }
  [[nodiscard]] std::size_t size() const { return ends_.size(); }

  /// The value of a site; none where it is missing. Of integers, reals, booleans and JSON, JSON's own text.
  [[nodiscard]] std::optional<std::string_view> at(std::size_t site) const;

  /// Bytes of memory that its values take.
  [[nodiscard]] std::uint64_t bytes() const {
    return text_.capacity() + ends_.capacity() * sizeof(std::uint64_t);
  }

  /// The value of the next site.
  void add(std::optional<std::string_view> value);

  /// The same with each value rewritten; those that are missing stay so.
  [[nodiscard]] Attribute rewritten(AttributeType type, std::string (*rewrite)(std::string_view)) const;

  void rename(std::string name) { name_ = std::move(name); }
  void setType(AttributeType type) { type_ = type; }

  /// Takes the narrowest of integer, real and boolean that all values are written as; text where the values
  /// have no such type in common, or where all of them are missing.
  void inferType();

 private:
  std::string name_;
  AttributeType type_;
  std::string text_;  ///< all values, one after the other
  std::vector<std::uint64_t>
      ends_;  ///< by site: where its value ends in text_, twice; plus 1 where it is missing
};

/// Whether text is a number as JSON has it, and whether it is one without fraction and exponent that 64 bits
/// with a sign hold.
bool isJsonNumber(std::string_view text);
bool isJsonInteger(std::string_view text);

}  // namespace vorpipe
