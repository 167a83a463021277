#include "io/sites/attribute_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <unordered_map>

#include "io/base/error.h"
#include "io/base/number.h"
#include "io/base/quoted.h"

namespace vorpipe {
namespace {

/// Returns, for messages, what values of a type must be; empty if this one is that.
std::string_view missedBy(AttributeType type, std::string_view value) {
  switch (type) {
    case AttributeType::integer:
      return isJsonInteger(value) ? "" : "an integer of 64 bits";
    case AttributeType::real:
      return isJsonNumber(value) ? "" : "a number in JSON";
    case AttributeType::boolean:
      return value == "true" || value == "false" ? "" : "true or false";
    case AttributeType::json:
      if (value.find_first_of("\r\n") != std::string_view::npos) return "JSON in one line";
      return nlohmann::json::accept(value) ? "" : "JSON in one line";
    case AttributeType::text:
      break;
  }
  return isUtf8(value) ? "" : "UTF-8";
}

/// Takes the digits at the front of a text, without zeros that lead.
std::string_view takeNumber(std::string_view& text) {
  constexpr std::string_view digits = "0123456789";
  std::string_view number = text.substr(0, std::min(text.find_first_not_of(digits), text.size()));
  text.remove_prefix(number.size());
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

/// Whether one name comes before another: A2 before A10.
bool isBefore(std::string_view a, std::string_view b) {
  const std::string_view all_a = a, all_b = b;
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  while (!a.empty() && !b.empty()) {
    if (isDigit(a[0]) && isDigit(b[0])) {
      const std::string_view x = takeNumber(a), y = takeNumber(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      continue;
    }
    if (a[0] != b[0]) return static_cast<unsigned char>(a[0]) < static_cast<unsigned char>(b[0]);
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.empty() && b.empty() ? all_a < all_b : a.empty();
}

SiteValues namesOf(const Attribute& attribute) {
  SiteValues values;
  std::set<std::string_view, bool (*)(std::string_view, std::string_view)> names(isBefore);
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    if (const auto value = attribute.at(site)) names.insert(*value);
  }
  values.names.assign(names.begin(), names.end());
  std::unordered_map<std::string_view, std::uint32_t> index;
  for (const std::string& name : values.names) index.emplace(name, static_cast<std::uint32_t>(index.size()));
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    const auto value = attribute.at(site);
    values.name_of.push_back(value ? index.at(*value) : no_site);
  }
  return values;
}

SiteValues numbersOf(const Attribute& attribute) {
  SiteValues values;
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto value = attribute.at(site);
    values.numbers.push_back(value ? parseNumber(*value).value_or(none) : none);
  }
  return values;
}

}  // namespace

Result<const Attribute*> attributeNamed(std::span<const Attribute> attributes, std::string_view name) {
  const Attribute* const found = findNamed(attributes, name);
  if (found == nullptr) {
    std::vector<std::string> known;
    for (const Attribute& attribute : attributes) known.push_back(attribute.name());
    return inputError(fmt::format(
        "there is no attribute {}; {}", inQuotes(name),
        known.empty() ? "the sites have none" : fmt::format("known are {}", fmt::join(known, ", "))));
  }
  if (std::ranges::count(attributes, found->name(), &Attribute::name) > 1) {
    return inputError(fmt::format("there are several attributes {}", inQuotes(name)));
  }
  return found;
}

Result<SiteValues> valuesOf(const Attribute& attribute) {
  const AttributeType type = attribute.type();
  const bool numeric = type == AttributeType::integer || type == AttributeType::real;
  SiteValues values = numeric ? numbersOf(attribute) : namesOf(attribute);
  if (values.numbers.empty() && values.names.empty()) {
    return inputError(fmt::format("no site has a value of {}", inQuotes(attribute.name())));
  }
  values.title = attribute.name();
  return values;
}

std::vector<std::string> textsOf(const Attribute& attribute) {
  std::vector<std::string> texts;
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    texts.emplace_back(attribute.at(site).value_or(std::string_view()));
  }
  return texts;
}

Result<void> checkAttribute(const Attribute& attribute) {
  if (!isUtf8(attribute.name()))
    return inputError(fmt::format("{}: is not UTF-8", inQuotes(attribute.name())));
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    const auto value = attribute.at(site);
    const std::string_view missed = value ? missedBy(attribute.type(), *value) : "";
    if (missed.empty()) continue;
    return inputError(fmt::format("{}: {} of site {} is not {}", inQuotes(attribute.name()), inQuotes(*value),
                                  site, missed));
  }
  return {};
}

}  // namespace vorpipe
