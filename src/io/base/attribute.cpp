#include "io/base/attribute.h"

#include <algorithm>

#include "base/words.h"
#include "io/base/number.h"

namespace vorpipe {
namespace {

/// Takes digits off the front; returns whether there was one.
bool takeDigits(std::string_view& text) {
  const std::size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(count);
  return count > 0;
}

/// Whether some double is near this number: readers of JSON refuse numbers beyond all doubles.
bool hasValue(std::string_view number) {
  constexpr std::size_t most_digits = 308;
  if (number.size() <= most_digits && number.find_first_of("eE") == std::string_view::npos) return true;
  return parseNumber(number).has_value();
}

}  // namespace

const Attribute* findNamed(std::span<const Attribute> attributes, std::string_view name) {
  const Attribute* found = nullptr;
  std::size_t count = 0;
  for (const Attribute& attribute : attributes) {
    if (attribute.name() == name) return &attribute;
    if (lowerCase(attribute.name()) != lowerCase(name)) continue;
    found = &attribute;
    ++count;
  }
  return count == 1 ? found : nullptr;
}

bool isJsonInteger(std::string_view text) {
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  return wholeNumber<std::int64_t>(text) && (digits.size() == 1 || !digits.starts_with('0'));
}

bool isJsonNumber(std::string_view text) {
  const std::string_view number = text;
  if (text.starts_with('-')) text.remove_prefix(1);
  const bool zero = text.starts_with('0');
  const std::size_t before = text.size();
  if (!takeDigits(text) || (zero && before - text.size() > 1)) return false;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    if (!takeDigits(text)) return false;
  }
  if (text.starts_with('e') || text.starts_with('E')) {
    text.remove_prefix(1);
    if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
    if (!takeDigits(text)) return false;
  }
  return text.empty() && hasValue(number);
}

std::optional<std::string_view> Attribute::at(std::size_t site) const {
  if (ends_[site] % 2 == 1) return std::nullopt;
  const std::uint64_t begin = site == 0 ? 0 : ends_[site - 1] / 2;
  return std::string_view(text_).substr(begin, ends_[site] / 2 - begin);
}

void Attribute::add(std::optional<std::string_view> value) {
  if (value) text_.append(*value);
  ends_.push_back(text_.size() * 2 + (value ? 0 : 1));
}

Attribute Attribute::rewritten(AttributeType type, std::string (*rewrite)(std::string_view)) const {
  Attribute all(name_, type);
  for (std::size_t site = 0; site < size(); ++site) {
    if (const auto value = at(site)) {
      all.add(rewrite(*value));
    } else {
      all.add(std::nullopt);
    }
  }
  return all;
}

void Attribute::inferType() {
  bool any = false, integers = true, numbers = true, booleans = true;
  for (std::size_t site = 0; site < size() && (numbers || booleans); ++site) {
    const auto value = at(site);
    if (!value) continue;
    any = true;
    integers = integers && isJsonInteger(*value);
    numbers = numbers && (integers || isJsonNumber(*value));
    booleans = booleans && (*value == "true" || *value == "false");
  }
  type_ = AttributeType::text;
  if (any && booleans) type_ = AttributeType::boolean;
  if (any && numbers) type_ = integers ? AttributeType::integer : AttributeType::real;
}

}  // namespace vorpipe
