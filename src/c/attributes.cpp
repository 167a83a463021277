/// Attributes of sites besides their places and weights.
#include <fmt/core.h>

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "c/failure.h"
#include "c/handles.h"
#include "c/options.h"
#include "io/base/attribute.h"
#include "io/base/quoted.h"
#include "io/sites/attribute_values.h"

namespace vorpipe::c {
namespace {

vorpipe_attribute_type numberOf(AttributeType type) {
  return static_cast<vorpipe_attribute_type>(type) + VORPIPE_INTEGER;
}

/// Returns the attribute of an index; null if there is none.
const Attribute* attributeAt(const vorpipe_input* input, std::size_t index) {
  return input == nullptr || index >= input->attributes->size() ? nullptr : &(*input->attributes)[index];
}

/// Makes an attribute with the caller's values. Errors (input): those of checkAttribute; there is no such
/// type.
Result<Attribute> attributeOf(const char* name, vorpipe_attribute_type type, const vorpipe_text* values,
                              std::uint64_t count) {
  constexpr std::array types{AttributeType::text,    AttributeType::integer, AttributeType::real,
                             AttributeType::boolean, AttributeType::text,    AttributeType::json};
  const auto known = chosen(types, type, "type");
  if (!known) return tl::unexpected(known.error());
  Attribute attribute(name, *known);
  for (std::uint64_t site = 0; site < count; ++site) {
    const auto& [data, size] = values[site];
    attribute.add(data == nullptr ? std::nullopt : std::optional(std::string_view(data, size)));
  }
  if (type == VORPIPE_INFERRED) attribute.inferType();
  VORPIPE_TRY(checkAttribute(attribute));
  return attribute;
}

}  // namespace
}  // namespace vorpipe::c

using namespace vorpipe;
using namespace vorpipe::c;

size_t vorpipe_input_attribute_count(const vorpipe_input* input) {
  return input == nullptr ? 0 : input->attributes->size();
}

const char* vorpipe_input_attribute_name(const vorpipe_input* input, size_t attribute) {
  const Attribute* const at = attributeAt(input, attribute);
  return at == nullptr ? nullptr : at->name().c_str();
}

vorpipe_attribute_type vorpipe_input_attribute_type(const vorpipe_input* input, size_t attribute) {
  const Attribute* const at = attributeAt(input, attribute);
  return at == nullptr ? 0 : numberOf(at->type());
}

vorpipe_code vorpipe_input_attribute(const vorpipe_input* input, size_t attribute, uint64_t site,
                                     vorpipe_text* value) {
  if (input == nullptr) return missing("input");
  if (value == nullptr) return missing("value");
  return guarded([&] {
    const Attribute* const at = attributeAt(input, attribute);
    if (at == nullptr) return fail(VORPIPE_INPUT, fmt::format("attribute: there is no number {}", attribute));
    if (site >= at->size()) return fail(VORPIPE_INPUT, fmt::format("site: there is no number {}", site));
    const auto text = at->at(site);
    *value = text ? vorpipe_text{text->data(), text->size()} : vorpipe_text{nullptr, 0};
    return vorpipe_code{VORPIPE_DONE};
  });
}

vorpipe_code vorpipe_input_add_attribute(vorpipe_input* input, const char* name, vorpipe_attribute_type type,
                                         const vorpipe_text* values, uint64_t count) {
  if (input == nullptr) return missing("input");
  if (name == nullptr) return missing("name");
  if (values == nullptr && count > 0) return missing("values");
  return guarded([&] {
    if (count != input->sites->size()) {
      return fail(VORPIPE_INPUT, fmt::format("{}: {} values for {} sites", vorpipe::inQuotes(name), count,
                                             input->sites->size()));
    }
    auto attribute = attributeOf(name, type, values, count);
    if (!attribute) return fail(attribute.error());
    std::vector<Attribute> all = *input->attributes;
    all.push_back(std::move(*attribute));
    input->attributes = std::make_shared<const std::vector<Attribute>>(std::move(all));
    input->placed = nullptr;
    return vorpipe_code{VORPIPE_DONE};
  });
}
