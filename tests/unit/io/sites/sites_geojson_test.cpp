#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "unit/io/sites/sites_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class GeoJson : public SitesOfFiles {
 protected:
  static std::string feature(const std::string& geometry, const std::string& properties = "null",
                             const std::string& more = "") {
    return R"({"type":"Feature",)" + more + R"("properties":)" + properties + R"(,"geometry":)" + geometry +
           "}";
  }
  static std::string point(const std::string& position) {
    return R"({"type":"Point","coordinates":[)" + position + "]}";
  }
  static std::string collection(const std::string& features, const std::string& more = "") {
    return R"({"features":[)" + features + "]," + more + R"("type":"FeatureCollection"})";
  }
};

TEST_F(GeoJson, featuresHaveAttributesOfTheirTypes) {
  const SiteTable table =
      good("a.geojson",
           collection(feature(point("1,2"),
                              R"({"name":"K\u00f6ln","n":1,"q":1,"ok":true,"l":[1,{"a":"b"}],"m":"x"})") +
                      "," +
                      feature(R"({"type":"MultiPoint","coordinates":[[3,4],[5,6]]})",
                              R"({"name":null,"n":2,"q":2.5,"m":3})", R"("id":7,)") +
                      "," + feature(point("7,8"), "{}")));
  EXPECT_THAT(table.sites.x, ElementsAre(1, 3, 5, 7));
  EXPECT_THAT(table.sites.y, ElementsAre(2, 4, 6, 8));
  EXPECT_THAT(textsOf(table), ElementsAre("name (text): K\xC3\xB6ln, -, -, -", "n (integer): 1, 2, 2, -",
                                          "q (real): 1, 2.5, 2.5, -", "ok (boolean): true, -, -, -",
                                          "l (json): [1,{\"a\":\"b\"}], -, -, -", "m (json): \"x\", 3, 3, -",
                                          "id (integer): -, 7, 7, -"));
  EXPECT_EQ(table.system.kind, CoordinateKind::degrees);
  EXPECT_EQ(table.system.code, 4326);
  EXPECT_THAT(table.notes, IsEmpty());
}

TEST_F(GeoJson, collectionsHaveOneList) {
  const std::string one = feature(point("1,2"));
  EXPECT_EQ(bad("a.json", collection(one, "\"features\":[" + one + "],")).substr(0, 2), "1:");
  EXPECT_THAT(bad("a.json", collection(one, "\"features\":[" + one + "],")),
              HasSubstr("is a second list of features or geometries"));
}

TEST_F(GeoJson, nothingIsHiddenBehindAByteOfZero) {
  const std::string hidden = std::string("\0", 1) + "{}";
  const std::string what = "is no JSON from here on: a byte is 0";
  EXPECT_EQ(bad("a.json", point("1,2") + hidden), "1:37: " + what);
  EXPECT_EQ(bad("a.geojsonl", point("1,2") + hidden + "\n"), "1:37: " + what);
}

TEST_F(GeoJson, geometriesStandAlone) {
  EXPECT_THAT(good("a.json", point("1,2")).sites.x, ElementsAre(1));
  EXPECT_THAT(good("a.json", feature(point("1,2"))).sites.x, ElementsAre(1));
  EXPECT_THAT(good("a.json", R"({"type":"MultiPoint","coordinates":[[1,2],[3,4]]})").sites.x,
              ElementsAre(1, 3));
  EXPECT_THAT(good("a.json", R"({"type":"GeometryCollection","geometries":[)" + point("1,2") + "," +
                                 point("3,4") + "]}")
                  .sites.y,
              ElementsAre(2, 4));
  EXPECT_THAT(good("a.json", "\xEF\xBB\xBF" + point("1,2")).sites.x, ElementsAre(1));
  const SiteTable high = good("a.json", point("1,2,300"));
  EXPECT_EQ(notes(high), ": of positions x and y are taken, and nothing of their other numbers\n");
}

TEST_F(GeoJson, weightsAreProperties) {
  const SiteTable table = good("a.geojson", collection(feature(point("1,2"), R"({"Radius":3})") + "," +
                                                       feature(point("3,4"), R"({"Radius":0.5})")));
  EXPECT_THAT(table.sites.weight, ElementsAre(9, 0.25));
  EXPECT_THAT(table.attributes, IsEmpty());
  EXPECT_EQ(notes(table), ": the property \"Radius\" is taken as radius, whose square is the weight\n");
  const std::string none = feature(point("1,2")), one = feature(point("3,4"), R"({"weight":1})");
  EXPECT_EQ(bad("a.json", collection(none + "," + one)),
            " features[1]: has a weight, and those before it have none");
  EXPECT_EQ(bad("a.json", collection(one + "," + none)),
            " features[1]: has no weight, and those before it have");
  const SiteTable skipped = good("a.json", collection(none + "," + one + "," + none), skipping());
  EXPECT_THAT(skipped.sites.x, ElementsAre(3));
  EXPECT_EQ(skipped.skipped, 2u);
  EXPECT_EQ(bad("a.json", collection(feature(point("1,2"), R"({"weight":1,"radius":1})"))),
            " features[0]: has both \"weight\" and \"radius\"; keep one");
  EXPECT_EQ(bad("a.json", collection(feature(point("1,2"), R"({"weight":"1"})"))),
            " features[0].properties.weight: a string, not a number");
  EXPECT_EQ(bad("a.json", collection(feature(point("1,2"), R"({"radius":-1})"))),
            " features[0].properties.radius: \"-1\" is negative, and a radius");
}

TEST_F(GeoJson, missingPlacesAreErrorsOrLeftOut) {
  const std::string bytes = collection(feature("null", R"({"a":1})") + "," +
                                       feature(point("1,2"), R"({"a":2})") + "," + feature(point("")));
  EXPECT_EQ(bad("a.json", bytes), " features[0]: has no place; --missing skip leaves such out");
  const SiteTable table = good("a.json", bytes, skipping());
  EXPECT_THAT(textsOf(table), ElementsAre("a (integer): 2"));
  EXPECT_EQ(table.skipped, 2u);
}

TEST_F(GeoJson, errorsNameTheFeature) {
  const std::string ok = feature(point("1,2")) + ",";
  EXPECT_EQ(
      bad("cities.geojson", collection(ok + ok + ok + feature(R"({"type":"Polygon","coordinates":[]})"))),
      " features[3]: a Polygon where a Point is needed");
  EXPECT_EQ(bad("a.json", collection(ok + feature(point(R"("1","2")")))),
            " features[1]: no position: two numbers or more are needed");
  EXPECT_EQ(bad("a.json", collection(ok + feature(point("1")))),
            " features[1]: no position: two numbers or more are needed");
  EXPECT_EQ(bad("a.json", collection(ok + "5")), " features[1]: a number, not an object");
  EXPECT_EQ(bad("a.json", collection(ok + "[]")), " features[1]: a array, not an object");
  EXPECT_EQ(bad("a.json", collection(ok + R"({"type":"Feature"})")), " features[1]: has no \"geometry\"");
  EXPECT_EQ(bad("a.json", collection(ok + feature(R"({"type":"Sphere"})"))),
            " features[1]: a \"Sphere\" where a Point is needed");
  EXPECT_EQ(bad("a.json", R"({"type":"FeatureCollection"})"), " the top object: has no array \"features\"");
  EXPECT_EQ(bad("a.json", R"({"type":"Other","features":[]})"),
            " the top object: has \"features\", and is no collection of them");
  EXPECT_EQ(bad("a.json", R"({"type":"Feature","features":[{}]})"),
            " features[0]: has no \"type\" that is a string");
  EXPECT_EQ(bad("a.json", "[1]"), " the top object: a array, not an object");
  EXPECT_EQ(bad("a.json", collection("")), " holds no sites");
}

TEST_F(GeoJson, whatIsNoJsonIsNamedByItsPlace) {
  EXPECT_EQ(bad("a.json", "{\"type\":\n  \"Point\",]"), "2:11: is no JSON from here on");
  EXPECT_EQ(bad("a.json", ""), "1:1: is no JSON from here on");
  EXPECT_EQ(bad("a.json", "{\n\n"), "3:1: is no JSON from here on");
  EXPECT_EQ(bad("a.json", "[1\n2]"), "2:1: is no JSON from here on");
  EXPECT_EQ(bad("a.json", "{\"type\":\"Point\",\n \"coordinates\":[0,-1e999]}"),
            "2:19: the number is too large for a double");
  std::string deep(100000, '[');
  EXPECT_EQ(bad("a.json", deep), "1:201: stands in more than 200 lists and objects");
  EXPECT_EQ(bad("a.json", collection(feature(point("1,2"), R"({"a":)" + deep + "}"))).substr(0, 2), "1:");
  std::string nested;
  for (int k = 0; k < 50; ++k) nested += R"({"type":"GeometryCollection","geometries":[)";
  nested += point("1,2");
  for (int k = 0; k < 50; ++k) nested += "]}";
  EXPECT_THAT(bad("a.json", feature(nested)), HasSubstr("stands in more than 32 collections"));
}

TEST_F(GeoJson, ofOldMayNameASystem) {
  const auto crs = [](const std::string& name) {
    return R"("crs":{"type":"name","properties":{"name":")" + name + R"("}},)";
  };
  const SiteTable table =
      good("a.json", collection(feature(point("500000,2")), crs("urn:ogc:def:crs:EPSG::3857")));
  EXPECT_EQ(table.system.kind, CoordinateKind::plane);
  EXPECT_EQ(table.system.code, 3857);
  EXPECT_EQ(
      good("a.json", collection(feature(point("5,2")), crs("urn:ogc:def:crs:OGC:1.3:CRS84"))).system.code,
      4326);
  EXPECT_EQ(bad("a.json", collection(feature(point("5,2")), crs("Mars"))),
            " crs: \"Mars\" is no system of EPSG and not CRS84");
}

TEST_F(GeoJson, mayComeLineByLine) {
  const std::string one = feature(point("1,2"), R"({"a":1})"), two = feature(point("3,4"), R"({"b":"x"})");
  for (const char* name : {"a.geojsonl", "a.geojsons", "a.ndjson"}) {
    const SiteTable table = good(name, one + "\n\n\x1E" + two + "\r\n");
    EXPECT_THAT(table.sites.x, ElementsAre(1, 3));
    EXPECT_THAT(textsOf(table), ElementsAre("a (integer): 1, -", "b (text): -, x"));
  }
  EXPECT_EQ(bad("a.ndjson", one + "\n\x1E" + " {,}\n"), "2:4: is no JSON from here on");
  EXPECT_EQ(bad("a.ndjson", one + "\n" + feature("null")), "2: has no place; --missing skip leaves such out");
  EXPECT_EQ(bad("a.ndjson", one + "\n" + std::string(300, '[')),
            "2:201: stands in more than 200 lists and objects");
  EXPECT_EQ(bad("a.ndjson", collection(one)), "1: a FeatureCollection where a Feature is needed");
}

}  // namespace
}  // namespace vorpipe::test
