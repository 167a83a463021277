#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "io/cells/cell_attributes.h"
#include "io/sites/sites_file.h"
#include "unit/io/cells/cells_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using Values = std::vector<std::optional<std::string>>;

Attribute attribute(const std::string& name, AttributeType type, const Values& values) {
  Attribute made(name, type);
  for (const auto& value : values) made.add(value);
  return made;
}

/// One of each type for someSites(), with what formats have to escape.
std::vector<Attribute> someAttributes() {
  return {attribute("name", AttributeType::text,
                    {"a,b", "say \"hi\"", std::nullopt, "two\nlines", "K\xC3\xB6ln"}),
          attribute("count", AttributeType::integer, {"1", "-9007199254740993", std::nullopt, "0", "5"}),
          attribute("rain, mm", AttributeType::real, {"0.10", "1e300", "2", std::nullopt, "-0.5"}),
          attribute("open", AttributeType::boolean, {"true", "false", std::nullopt, "true", "true"}),
          attribute("tags", AttributeType::json, {"[1,\"a\"]", "{\"k\":null}", std::nullopt, "\"t\"", "7"}),
          attribute("Area", AttributeType::text, {"", " x", "y ", "\x01", "\xFF!"})};
}

TEST(AttributeNames, AreTheirOwnUnlessAFieldHasThem) {
  const std::vector<Attribute> attributes{Attribute("name"),       Attribute("area"), Attribute("NAME"),
                                          Attribute("input_area"), Attribute(""),     Attribute("Fid"),
                                          Attribute("id")};
  EXPECT_THAT(attributeNames(attributes), ElementsAre("name", "input_area", "input_NAME", "input_input_area",
                                                      "input_", "input_Fid", "id"));
  EXPECT_THAT(renamingNote(attributes), AllOf(HasSubstr("\"area\" to \"input_area\", \"NAME\" to"),
                                              Not(HasSubstr("\"id\"")), Not(HasSubstr("\n"))));
  EXPECT_EQ(renamingNote(std::span(attributes).first(1)), "");
  // The row numbers of a GeoPackage, which its user did not name.
  EXPECT_EQ(renamingNote(std::vector{Attribute("fid", AttributeType::integer)}), "");
}

class CellsWithAttributes : public CellsFile {
 protected:
  [[nodiscard]] std::string bytesOf(const std::string& name, bool only_cells = false) const {
    MemorySink sink(name);
    const auto attributes = someAttributes();
    const auto result =
        writeCells(sink, {someSites(), someCells(), attributes, wgs84(), only_cells}, **cellsFormatOf(name));
    EXPECT_TRUE(result) << result.error().message;
    return sink.take();
  }
};

TEST_F(CellsWithAttributes, InCsvFollowRecordsQuotedWhereTheyMust) {
  const std::string text = bytesOf("c.csv");
  EXPECT_THAT(text,
              StartsWith("site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors,"
                         "name,count,\"rain, mm\",open,tags,input_Area\n"));
  EXPECT_THAT(
      text,
      AllOf(HasSubstr(",-3 1 4 -4 -1,\"a,b\",1,0.10,true,\"[1,\"\"a\"\"]\",\"\"\n"),
            HasSubstr(",-3 -2 4 0,\"say \"\"hi\"\"\",-9007199254740993,1e300,false,\"{\"\"k\"\":null}\","
                      "\" x\"\n"),
            HasSubstr("2,0.25,0.5,0,duplicate,0,0,0.25,0.5,0,,,,2,,,\"y \"\n"),
            HasSubstr(",\"two\nlines\",0,,true,\"\"\"t\"\"\",\x01\n"),
            EndsWith(",K\xC3\xB6ln,5,-0.5,true,7,\xFF!\n")));
}

TEST_F(CellsWithAttributes, AreReadBackFromCsvWhateverTheyAreNamed) {
  const std::vector<std::string> names{";;;;;;;;;;;;;;;;", "\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t\t", "a\nb", "|"};
  std::vector<Attribute> attributes;
  for (const auto& name : names) attributes.push_back(attribute(name, AttributeType::text, Values(5, "1;2")));
  MemorySink sink("c.csv");
  ASSERT_TRUE(writeCells(sink, {someSites(), someCells(), attributes}, **cellsFormatOf("c.csv")));
  ReadOptions options;
  options.columns = {"x", "y"};
  const auto table = readSites(write("c.csv", sink.take()), options);
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->sites.x, someSites().x);
  std::vector<std::string> read;
  for (const Attribute& one : table->attributes) {
    if (one.at(0) == "1;2") read.push_back(one.name());
  }
  EXPECT_EQ(read, names);
}

TEST_F(CellsWithAttributes, InGeoJsonKeepTheirTypes) {
  const std::string text = bytesOf("c.geojson");
  EXPECT_THAT(text,
              AllOf(HasSubstr("\"neighbors\":[-3,1,4,-4,-1],\"name\":\"a,b\",\"count\":1,\"rain, mm\":0.10,"
                              "\"open\":true,\"tags\":[1,\"a\"],\"input_Area\":\"\"},\"geometry\":{"),
                    HasSubstr("\"name\":\"say \\\"hi\\\"\",\"count\":-9007199254740993,"),
                    HasSubstr("\"name\":null,\"count\":null,\"rain, mm\":2,\"open\":null,\"tags\":null,"),
                    HasSubstr("\"name\":\"two\\nlines\""), HasSubstr("\"input_Area\":\"\\u0001\""),
                    HasSubstr("\"name\":\"K\xC3\xB6ln\""), HasSubstr("\"input_Area\":\"\xEF\xBF\xBD!\"")));
}

TEST_F(CellsWithAttributes, AreLeftOutWithTheRecordsThatHaveNoCell) {
  const std::string whole = bytesOf("c.geojson", true), lines = bytesOf("c.geojsonl", true);
  for (const std::string& text : {whole, lines}) {
    EXPECT_THAT(text, AllOf(HasSubstr("\"id\":0,"), HasSubstr("\"id\":1,"), Not(HasSubstr("\"id\":2,")),
                            Not(HasSubstr("\"id\":3,")), HasSubstr("\"id\":4,")));
  }
  EXPECT_EQ(std::ranges::count(whole, '\n'), 5);
  EXPECT_EQ(std::ranges::count(lines, '\n'), 3);
  EXPECT_EQ(bytesOf("c.csv", true), bytesOf("c.csv"));
}

TEST_F(CellsWithAttributes, AreInGeoPackagesTheSameEveryTime) {
  const std::string bytes = bytesOf("c.gpkg");
  EXPECT_THAT(bytes, StartsWith("SQLite format 3"));
  EXPECT_EQ(bytes.substr(68, 4), "GPKG");
  EXPECT_EQ(bytes, bytesOf("c.gpkg"));
}

TEST_F(CellsWithAttributes, InGeoPackagesMustNotBeMoreThanItHolds) {
  std::vector<Attribute> attributes;
  for (int k = 0; k < 3000; ++k) {
    attributes.push_back(attribute("a" + std::to_string(k), AttributeType::text, Values(5)));
  }
  MemorySink sink("c.gpkg");
  const auto result = writeCells(sink, {someSites(), someCells(), attributes}, **cellsFormatOf("c.gpkg"));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::input);
  EXPECT_THAT(result.error().message, StartsWith("c.gpkg: cannot be a GeoPackage: too many columns"));
  EXPECT_TRUE(sink.bytes().empty());
}

}  // namespace
}  // namespace vorpipe::test
