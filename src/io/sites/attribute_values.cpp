#include "io/sites/attribute_values.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "io/base/error.h"
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

}  // namespace

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
