/// Site data of an input besides positions and weights: names, codes, figures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorpipe {

/// Type of an attribute's values.
enum class AttributeType : std::uint8_t {
  integer,  ///< as in JSON, within signed 64 bits
  real,     ///< numbers as in JSON
  boolean,  ///< true, false
  text,     ///< UTF-8
  json,     ///< any JSON, including lists and objects
};

/// One value for each site, in their order; a value may be missing. Values are kept as text, so that output
/// equals input: `007` stays text, and a number keeps its digits.
class Attribute {
 public:
  explicit Attribute(std::string name, AttributeType type = AttributeType::text)
      : name_(std::move(name)), type_(type) {}

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] AttributeType type() const { return type_; }
  [[nodiscard]] std::size_t size() const { return ends_.size(); }

  /// Returns the value of a site; none if it is missing. Integers, reals, booleans and JSON are JSON text.
  [[nodiscard]] std::optional<std::string_view> at(std::size_t site) const;

  /// Bytes of memory that its values take.
  [[nodiscard]] std::uint64_t bytes() const {
    return text_.capacity() + ends_.capacity() * sizeof(std::uint64_t);
  }

  /// Appends the value of the next site.
  void add(std::optional<std::string_view> value);

  /// Returns a copy with each value rewritten; missing values stay missing.
  [[nodiscard]] Attribute rewritten(AttributeType type, std::string (*rewrite)(std::string_view)) const;

  void rename(std::string name) { name_ = std::move(name); }
  void setType(AttributeType type) { type_ = type; }

  /// Sets the type to the narrowest of integer, real and boolean that fits all values; text if none fits or
  /// all values are missing.
  void inferType();

 private:
  std::string name_;
  AttributeType type_;
  std::string text_;  ///< all values, one after the other
  std::vector<std::uint64_t>
      ends_;  ///< by site: twice the end of its value in text_, plus 1 if it is missing
};

/// Returns the attribute with this name, else the only one whose name differs in case alone; null if there is
/// neither.
const Attribute* findNamed(std::span<const Attribute> attributes, std::string_view name);

/// Whether text is a JSON number; whether it is one that has no fraction or exponent and fits signed 64 bits.
bool isJsonNumber(std::string_view text);
bool isJsonInteger(std::string_view text);

}  // namespace vorpipe
