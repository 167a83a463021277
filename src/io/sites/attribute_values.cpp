#include "io/sites/attribute_values.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "io/base/error.h"
#include "io/base/quoted.h"
#include "io/base/utf8.h"

namespace vorpipe {
namespace {

/// Describes, for messages, what values of a type must be.
std::string_view nameOf(AttributeType type) {
  switch (type) {
    case AttributeType::integer:
      return "an integer of 64 bits";
    case AttributeType::real:
      return "a number in JSON";
    case AttributeType::boolean:
      return "true or false";
    case AttributeType::json:
      return "JSON in one line";
    case AttributeType::text:
      break;
  }
  return "UTF-8";
}

bool readsAs(AttributeType type, std::string_view value) {
  switch (type) {
    case AttributeType::integer:
      return isJsonInteger(value);
    case AttributeType::real:
      return isJsonNumber(value);
    case AttributeType::boolean:
      return value == "true" || value == "false";
    case AttributeType::json:
      return value.find_first_of("\r\n") == std::string_view::npos && nlohmann::json::accept(value);
    case AttributeType::text:
      break;
  }
  return isUtf8(value);
}

}  // namespace

Result<void> checkAttribute(const Attribute& attribute) {
  if (!isUtf8(attribute.name()))
    return inputError(fmt::format("{}: is not UTF-8", vorpipe::inQuotes(attribute.name())));
  for (std::size_t site = 0; site < attribute.size(); ++site) {
    const auto value = attribute.at(site);
    if (!value || readsAs(attribute.type(), *value)) continue;
    return inputError(fmt::format("{}: {} of site {} is not {}", vorpipe::inQuotes(attribute.name()),
                                  vorpipe::inQuotes(*value), site, nameOf(attribute.type())));
  }
  return {};
}

}  // namespace vorpipe
