#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>

#include "unit/io/cells/cells_fixture.h"

namespace vorpipe::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A file of each kind.
std::vector<std::string> allNames() {
  std::vector<std::string> names;
  for (const auto extension : cellsExtensions()) names.push_back("c" + std::string(extension));
  return names;
}

TEST(CellsFormatOf, GoesByTheExtension) {
  for (const std::string name :
       {"a.b/c.csv", "c.NPZ", "c.geojson", "c.svg", "c.obj", "c.Ply", "c.vtk", "./c.wkt"}) {
    const auto format = cellsFormatOf(name);
    ASSERT_TRUE(format) << name;
    std::string extension = name.substr(name.rfind('.'));
    std::ranges::transform(extension, extension.begin(), [](char c) { return std::tolower(c); });
    EXPECT_EQ((*format)->extension, extension);
  }
}

TEST(CellsFormatOf, NamesAllWhereItKnowsNone) {
  for (const std::string path : {"c.json", "csv", "c.csv/d", "c.", ""}) {
    const auto format = cellsFormatOf(path);
    ASSERT_FALSE(format) << path;
    EXPECT_EQ(format.error().code, ErrorCode::input);
    std::string known;
    for (const auto extension : cellsExtensions())
      known += (known.empty() ? "" : ", ") + std::string(extension);
    EXPECT_EQ(format.error().message, path + ": unknown kind of file for cells; known are " + known);
  }
}

TEST_F(CellsFile, SaysWhenTheDiskIsFull) {
  if (!OutputFile::create("/dev/full")) {
    GTEST_SKIP() << "there is no /dev/full here";
  }
  for (const std::string& name : allNames()) {
    auto file = OutputFile::create("/dev/full");
    ASSERT_TRUE(file);
    auto result = writeCells(*file, {someSites(), someCells()}, **cellsFormatOf(name));
    if (result) {
      result = file->commit();
    }
    ASSERT_FALSE(result) << name;
    EXPECT_EQ(result.error().code, ErrorCode::device) << name;
    EXPECT_THAT(result.error().message, StartsWith("/dev/full: ")) << name;
  }
}

TEST_F(CellsFile, IsTheSameEveryTime) {
  for (const std::string& name : allNames()) {
    const std::string first = written(name);
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(first, written(name)) << name;
  }
}

TEST_F(CellsFile, HasNoCellsWithoutSites) {
  Diagram none;
  none.cell_offsets = {0};
  EXPECT_THAT(written("c.csv", {}, none), EndsWith("neighbors\n"));
  EXPECT_EQ(written("c.geojson", {}, none), "{\"type\":\"FeatureCollection\",\"features\":[\n]}\n");
  EXPECT_EQ(written("c.wkt", {}, none), "GEOMETRYCOLLECTION EMPTY\n");
  EXPECT_THAT(written("c.svg", {}, none), EndsWith("</svg>\n"));
  EXPECT_THAT(written("c.vtk", {}, none), HasSubstr("POLYGONS 0 0\n"));
}

TEST_F(CellsFile, CsvHasARowForEachSite) {
  EXPECT_EQ(written("c.csv"),
            "site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors\n"
            "0,0.25,0.5,0,ok,0.3333333333333333,2.6666666666666665,0.16666666666666666,0.5,5,-3 1 4 -4 -1\n"
            "1,0.5,0.05,0,ok,0.06666666666666668,1.5333333333333334,0.6666666666666666,0.05,4,-3 -2 4 0\n"
            "2,0.25,0.5,0,duplicate,0,0,0.25,0.5,0,\n"
            "3,7,0.5,0,empty,0,0,7,0.5,0,\n"
            "4,0.5,0.75,0,ok,0.6000000000000001,3.1333333333333333,0.6666666666666666,0.55,4,-2 -4 0 1\n");
}

TEST_F(CellsFile, CsvHasTheWeights) {
  Sites sites = someSites();
  sites.weight = {-1.5, 1e-300, 0, 1e22, 5e-324};
  EXPECT_THAT(written("c.csv", sites, someCells()),
              AllOf(HasSubstr("0,0.25,0.5,-1.5,ok"), HasSubstr("1,0.5,0.05,1e-300,ok"),
                    HasSubstr("3,7,0.5,1e+22,empty"), HasSubstr("4,0.5,0.75,5e-324,ok")));
}

TEST_F(CellsFile, CsvNumbersReadBackToTheSameDouble) {
  std::mt19937_64 random(1);
  Sites sites = someSites();
  for (int round = 0; round < 1000; ++round) {
    sites.weight.clear();
    while (sites.weight.size() < sites.size()) {
      const auto number = std::bit_cast<double>(random());
      if (std::isfinite(number)) {
        sites.weight.push_back(number);
      }
    }
    written("c.csv", sites, someCells());
    std::ifstream rows(path("c.csv"));
    std::string text;
    std::getline(rows, text);
    for (const double weight : sites.weight) {
      for (int column = 0; column < 4; ++column) {
        std::getline(rows, text, ',');
      }
      ASSERT_EQ(std::strtod(text.c_str(), nullptr), weight) << text;
      std::getline(rows, text);
    }
  }
}

TEST_F(CellsFile, GeoJsonHasAFeatureForEachSite) {
  EXPECT_THAT(
      written("c.geojson"),
      AllOf(
          StartsWith("{\"type\":\"FeatureCollection\",\"features\":[\n{\"type\":\"Feature\",\"id\":0,"),
          HasSubstr(
              "{\"type\":\"Feature\",\"id\":1,\"properties\":{\"x\":0.5,\"y\":0.05,\"status\":\"ok\","
              "\"owner\":1,\"area\":0.06666666666666668,\"perimeter\":1.5333333333333334,"
              "\"centroid\":[0.6666666666666666,0.05],\"neighbors\":[-3,-2,4,0]},"
              "\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[[0.3333333333333333,0],[1,0],[1,0.1],"
              "[0.3333333333333333,0.1],[0.3333333333333333,0]]]}},\n"),
          HasSubstr("\n{\"type\":\"Feature\",\"id\":2,\"properties\":{\"x\":0.25,\"y\":0.5,"
                    "\"status\":\"duplicate\",\"owner\":0,\"area\":0,\"perimeter\":0,\"centroid\":[0.25,0.5],"
                    "\"neighbors\":[]},\"geometry\":null},\n"),
          EndsWith("}\n]}\n"), Not(HasSubstr("weight"))));
  Sites sites = someSites();
  sites.weight = {1, 2, 3, 4, 5};
  EXPECT_THAT(written("c.geojson", sites, someCells()), HasSubstr("\"y\":0.5,\"weight\":3,\"status\""));
}

TEST_F(CellsFile, WktHasAPolygonForEachSite) {
  const std::string t = "0.3333333333333333";
  EXPECT_EQ(written("c.wkt"),
            "GEOMETRYCOLLECTION (\n"
            "POLYGON ((0 0, " +
                t + " 0, " + t + " 0.1, " + t +
                " 1, 0 1, 0 0)),\n"
                "POLYGON ((" +
                t + " 0, 1 0, 1 0.1, " + t + " 0.1, " + t +
                " 0)),\n"
                "POLYGON EMPTY,\n"
                "POLYGON EMPTY,\n"
                "POLYGON ((1 0.1, 1 1, " +
                t + " 1, " + t +
                " 0.1, 1 0.1))\n"
                ")\n");
}

TEST_F(CellsFile, SvgHasPixelsWithYDownward) {
  const std::string text = written("c.svg");
  EXPECT_THAT(text, AllOf(StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" "
                                     "height=\"1000\" viewBox=\"0 0 1000 1000\">\n"),
                          HasSubstr(" points=\"333.33333,1000 1000,1000 1000,900 333.33333,900\">"
                                    "<title>site 1, area 0.06666666666666668</title></polygon>\n"),
                          Not(HasSubstr("site 2")), Not(HasSubstr("site 3")), EndsWith("</svg>\n")));
}

TEST_F(CellsFile, SvgKeepsTheAspect) {
  Diagram cells = someCells();
  for (Point& vertex : cells.vertices) {
    vertex = {1e6 + vertex.x, -4 * vertex.y};
  }
  EXPECT_THAT(written("c.svg", someSites(), cells),
              AllOf(HasSubstr("width=\"250\" height=\"1000\" viewBox=\"0 0 250 1000\""),
                    HasSubstr(" points=\"83.333333,0 250,0 250,100 83.333333,100\">")));
}

TEST_F(CellsFile, CsvHasRingsShiftsAndMassWhereThereAre) {
  const std::string columns =
      "site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors";
  EXPECT_THAT(written("c.csv", sitesInPieces(), cellsInPieces()),
              AllOf(StartsWith(columns + ",rings\n"), HasSubstr("11,-5 -5 -5 -5 1 1 1 1 -5 -5 -5,3\n"),
                    HasSubstr("4,0 0 0 0,1\n"), EndsWith("9,9,0,,0\n")));
  EXPECT_THAT(written("c.csv", someSites(), cellsWithShiftsAndMass()),
              AllOf(StartsWith(columns + ",neighbor_shifts,mass,mass_centroid_x,mass_centroid_y\n"),
                    HasSubstr("5,-3 1 4 -4 -1,0:-1 0:0 0:0 0:0 0:0,0.1,0.16666666666666666,0.5\n"),
                    HasSubstr("2,0.25,0.5,0,duplicate,0,0,0.25,0.5,0,,,0,0.25,0.5\n"),
                    EndsWith("4,-2 -4 0 1,0:0 0:0 0:0 1:2,3,0.6666666666666666,0.55\n")));
}

TEST_F(CellsFile, GeoJsonHasPiecesShiftsAndMassWhereThereAre) {
  EXPECT_THAT(written("c.geojson", sitesInPieces(), cellsInPieces()),
              AllOf(HasSubstr("{\"type\":\"MultiPolygon\",\"coordinates\":["
                              "[[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]],"
                              "[[[5,0],[6,0],[5,1],[5,0]]]]}"),
                    HasSubstr("{\"type\":\"Polygon\",\"coordinates\":[[[1,1],[2,1],[2,2],[1,2],[1,1]]]}"),
                    Not(HasSubstr("mass")), Not(HasSubstr("shifts"))));
  EXPECT_THAT(
      written("c.geojson", someSites(), cellsWithShiftsAndMass()),
      AllOf(HasSubstr("\"mass\":0.1,\"mass_centroid\":[0.16666666666666666,0.5],\"neighbors\":[-3,1,4,-4,-1],"
                      "\"neighbor_shifts\":[[0,-1],[0,0],[0,0],[0,0],[0,0]]}"),
            HasSubstr("\"neighbors\":[],\"neighbor_shifts\":[]}")));
}

TEST_F(CellsFile, WktHasAMultipolygonForACellInPieces) {
  EXPECT_EQ(written("c.wkt", sitesInPieces(), cellsInPieces()),
            "GEOMETRYCOLLECTION (\n"
            "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1)), ((5 0, 6 0, 5 1, 5 0))),\n"
            "POLYGON ((1 1, 2 1, 2 2, 1 2, 1 1)),\n"
            "POLYGON EMPTY\n"
            ")\n");
}

TEST_F(CellsFile, SvgHasAPathForACellInPieces) {
  const std::string text = written("c.svg", sitesInPieces(), cellsInPieces());
  EXPECT_THAT(text, AllOf(HasSubstr("fill-rule:evenodd"),
                          HasSubstr(" d=\"M0,666.66667 666.66667,666.66667 666.66667,0 0,0ZM"),
                          HasSubstr("Z\"><title>site 0, area 15.5</title></path>\n<polygon "),
                          HasSubstr("<title>site 1, area 1</title></polygon>\n</svg>")));
}

}  // namespace
}  // namespace vorpipe::test
