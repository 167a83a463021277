#include "io/base/attribute_fields.h"

#include <charconv>
#include <string_view>

#include "io/base/field_text.h"

namespace vorpipe {

FieldType fieldType(AttributeType type) {
  switch (type) {
    case AttributeType::integer:
      return FieldType::integer;
    case AttributeType::real:
      return FieldType::real;
    case AttributeType::boolean:
      return FieldType::boolean;
    case AttributeType::text:
    case AttributeType::json:
      break;
  }
  return FieldType::text;
}

namespace {

template <class Number>
Number numberOf(std::string_view text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

void addValue(FeatureRow& row, const Attribute& attribute, std::size_t site) {
  const auto value = attribute.at(site);
  if (!value) return row.addMissing();
  switch (attribute.type()) {
    case AttributeType::integer:
      return row.add(numberOf<std::int64_t>(*value));
    case AttributeType::real:
      return row.add(numberOf<double>(*value));
    case AttributeType::boolean:
      return row.add(std::int64_t{*value == "true"});
    case AttributeType::text:
    case AttributeType::json:
      break;
  }
  row.add(std::string_view(utf8Of(*value)));
}

}  // namespace vorpipe
