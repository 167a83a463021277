#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "io/cells/edges_file.h"
#include "unit/io/cells/cells_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string bytesOf(const std::string& name, const Diagram& cells) {
  const auto topology = topologyOf(cells);
  EXPECT_TRUE(topology) << topology.error().message;
  MemorySink sink(name);
  const auto result = writeLines(sink, edgesOf(Sites{}, cells, *topology, {}), **edgesFormatOf(name));
  EXPECT_TRUE(result) << result.error().message;
  return sink.take();
}

TEST(EdgesFile, HasEachEdgeOnce) {
  EXPECT_EQ(bytesOf("e.csv", someCells()),
            "edge,site_a,site_b,length,x1,y1,x2,y2\n"
            "0,0,-3,0.3333333333333333,0,0,0.3333333333333333,0\n"
            "1,0,1,0.1,0.3333333333333333,0,0.3333333333333333,0.1\n"
            "2,0,4,0.9,0.3333333333333333,0.1,0.3333333333333333,1\n"
            "3,0,-4,0.3333333333333333,0.3333333333333333,1,0,1\n"
            "4,0,-1,1,0,1,0,0\n"
            "5,1,-3,0.6666666666666666,0.3333333333333333,0,1,0\n"
            "6,1,-2,0.1,1,0,1,0.1\n"
            "7,1,4,0.6666666666666666,1,0.1,0.3333333333333333,0.1\n"
            "8,4,-2,0.9,1,0.1,1,1\n"
            "9,4,-4,0.6666666666666666,1,1,0.3333333333333333,1\n");
}

TEST(EdgesFile, GoesAroundEachRing) {
  EXPECT_THAT(bytesOf("e.wkt", cellsInPieces()),
              AllOf(StartsWith("GEOMETRYCOLLECTION (\nLINESTRING (0 0, 4 0),\n"),
                    HasSubstr("LINESTRING (0 4, 0 0),\n"), HasSubstr("LINESTRING (2 1, 1 1),\n"),
                    HasSubstr("LINESTRING (5 1, 5 0)\n)\n")));
}

TEST(EdgesFile, OfNoSitesIsAFileAllTheSame) {
  Diagram none;
  none.cell_offsets = {0};
  for (const auto extension : edgesExtensions()) {
    EXPECT_EQ(bytesOf("e" + std::string(extension), none).empty(), extension == ".geojsonl") << extension;
  }
  EXPECT_EQ(bytesOf("e.wkt", none), "GEOMETRYCOLLECTION EMPTY\n");
}

TEST(EdgesFile, HasLineStringsInGeoJson) {
  EXPECT_THAT(
      bytesOf("e.geojson", someCells()),
      HasSubstr("\n{\"type\":\"Feature\",\"id\":7,\"properties\":{\"edge\":7,\"site_a\":1,\"site_b\":4,"
                "\"length\":0.6666666666666666},\"geometry\":{\"type\":\"LineString\",\"coordinates\":"
                "[[1,0.1],[0.3333333333333333,0.1]]}},\n"));
}

TEST(EdgesFile, IsOfAKnownKind) {
  const auto format = edgesFormatOf("e.npz");
  ASSERT_FALSE(format);
  EXPECT_EQ(format.error().message,
            "e.npz: unknown kind of file for edges; known are .csv, .geojson, .geojsonl, .gpkg, .wkt, .vtp");
}

}  // namespace
}  // namespace vorpipe::test
