#include "io/base/coordinate_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vorpipe::test {
namespace {

CoordinateSystem named(std::string_view text) {
  auto system = systemNamed(text);
  EXPECT_TRUE(system) << system.error();
  return system ? *system : CoordinateSystem{};
}

TEST(CoordinateSystems, areNamedByCodesUrnsAddressesAndDefinitions) {
  for (const char* text : {"EPSG:25832", "epsg:25832", "25832", " urn:ogc:def:crs:EPSG::25832",
                           "http://www.opengis.net/def/crs/EPSG/0/25832",
                           R"(PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",AUTHORITY["EPSG","4258"]],)"
                           R"(AUTHORITY["EPSG","25832"]])",
                           R"(PROJCRS["ETRS89 / UTM zone 32N",BASEGEOGCRS["ETRS89",ID["EPSG",4258]],)"
                           R"(ID["EPSG",25832]])",
                           R"(PROJCS["ETRS_1989_UTM_Zone_32N",GEOGCS["GCS_ETRS_1989"]])"}) {
    EXPECT_EQ(nameOf(named(text)), "EPSG:25832") << text;
    EXPECT_EQ(named(text).kind, CoordinateKind::plane) << text;
  }
  for (const char* text : {"OGC:CRS84", "urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326",
                           R"(GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984"]])"}) {
    EXPECT_EQ(nameOf(named(text)), "EPSG:4326") << text;
    EXPECT_EQ(named(text).kind, CoordinateKind::degrees) << text;
  }
  EXPECT_EQ(nameOf(named(R"(PROJCS["My grid",GEOGCS["X"]])")), "My grid");
  for (const char* text : {"", "Mars", "EPSG:", "EPSG:-3", "IGNF:LAMB93", "FRUIT[\"apple\"]"}) {
    EXPECT_FALSE(systemNamed(text)) << text;
  }
}

TEST(CoordinateSystems, areOneNearUnclearOrDifferent) {
  const CoordinateSystem unknown, degrees{CoordinateKind::degrees}, plane{CoordinateKind::plane};
  EXPECT_EQ(compared(unknown, named("25832")), SystemsAre::one);
  EXPECT_EQ(compared(degrees, named("4314")), SystemsAre::one);
  EXPECT_EQ(compared(degrees, plane), SystemsAre::unclear);
  EXPECT_EQ(compared(degrees, named("25832")), SystemsAre::different);
  EXPECT_EQ(compared(named("25832"), named("4326")), SystemsAre::different);
  EXPECT_EQ(compared(named("25832"), named("25833")), SystemsAre::different);
  EXPECT_EQ(compared(named("25832"), named("EPSG:25832")), SystemsAre::one);
  EXPECT_EQ(compared(named("3857"), named("900913")), SystemsAre::one);
  EXPECT_EQ(compared(named("4258"), wgs84()), SystemsAre::near);
  EXPECT_EQ(compared(named("4314"), wgs84()), SystemsAre::different);
  const auto grid = named(R"(PROJCS["My grid",GEOGCS["X"]])");
  EXPECT_EQ(compared(grid, named(R"(PROJCS["My grid", GEOGCS["X"]])")), SystemsAre::one);
  EXPECT_EQ(compared(grid, named("25832")), SystemsAre::unclear);
}

TEST(CoordinateSystems, unitsOfAreaAreKnownByDefinitionsAndUsualCodes) {
  const auto unit = [](std::string_view text) { return squareKilometersIn(named(text)).value_or(0); };
  for (const char* metric :
       {"25832", "32601", "2154", "27700", "3035",
        R"(PROJCS["My grid",GEOGCS["X",UNIT["degree",0.017]],UNIT["metre",1]])",
        R"(PROJCRS["My grid",CS[Cartesian,2],AXIS["E",east,LENGTHUNIT["metre", 1.0]]])"}) {
    EXPECT_DOUBLE_EQ(unit(metric), 1e-6) << metric;
  }
  EXPECT_DOUBLE_EQ(unit(R"(PROJCS["Feet",GEOGCS["X",UNIT["degree",0.017]],UNIT["foot",0.3048]])"),
                   0.3048 * 0.3048 * 1e-6);
  for (const char* other :
       {"4326", "3857", "3395", "2225", "32662", R"(PROJCS["My grid",GEOGCS["X",UNIT["degree",0.017]]])",
        R"(PROJCS["World_Mercator",PROJECTION["Mercator"],UNIT["metre",1]])"}) {
    EXPECT_EQ(unit(other), 0) << other;
  }
  EXPECT_DOUBLE_EQ(unit(R"(PROJCS["Mine",PROJECTION["Transverse_Mercator"],UNIT["metre",1]])"), 1e-6);
  EXPECT_EQ(squareKilometersIn({}), std::nullopt);
}

}  // namespace
}  // namespace vorpipe::test
