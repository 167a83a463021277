#include "io/sites/attribute_values.h"

#include <gtest/gtest.h>

#include <string_view>

namespace vorpipe::test {
namespace {

/// What is wrong with a value; empty: nothing.
std::string faultOf(AttributeType type, std::string_view value) {
  Attribute attribute("column", type);
  attribute.add(std::nullopt);
  attribute.add(value);
  const auto checked = checkAttribute(attribute);
  return checked ? "" : checked.error().message;
}

TEST(AttributeValues, readAsTheirType) {
  EXPECT_EQ(faultOf(AttributeType::integer, "-9223372036854775808"), "");
  EXPECT_EQ(faultOf(AttributeType::integer, "007"),
            "\"column\": \"007\" of site 1 is not an integer of 64 bits");
  EXPECT_EQ(faultOf(AttributeType::real, "1e-3"), "");
  EXPECT_NE(faultOf(AttributeType::real, "nan"), "");
  EXPECT_EQ(faultOf(AttributeType::boolean, "true"), "");
  EXPECT_NE(faultOf(AttributeType::boolean, "True"), "");
  EXPECT_EQ(faultOf(AttributeType::json, R"({"a": [1, null]})"), "");
  EXPECT_NE(faultOf(AttributeType::json, "{a: 1}"), "");
  EXPECT_EQ(faultOf(AttributeType::text, "line\nbreak"), "");
  EXPECT_NE(faultOf(AttributeType::text, "\xFF"), "");
}

TEST(AttributeValues, JsonIsOneLineAsRecordsOfOneLineTakeIt) {
  EXPECT_NE(faultOf(AttributeType::json, "[1,\n2]"), "");
}

}  // namespace
}  // namespace vorpipe::test
