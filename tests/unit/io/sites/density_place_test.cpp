#include "io/sites/density_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vorpipe::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PlacedSites inSquare() {
  PlacedSites placed;
  placed.domain = {0, 0, 10, 10};
  placed.system = systemOfCode(25832);
  return placed;
}

DensityFile pixelsIn(int width, int height, const std::optional<Box>& box = {}) {
  return {{width, height, std::vector<double>(static_cast<std::size_t>(width * height), 1), box}, {}};
}

std::vector<std::string> notesOn(const DensityFile& density, const std::string& name) {
  PlacedSites placed = inSquare();
  const auto looked = placeDensity(density, name, placed);
  EXPECT_TRUE(looked) << looked.error().message;
  return placed.notes;
}

TEST(DensityPlace, pixelsThatAreStretchedAreNoted) {
  EXPECT_THAT(notesOn(pixelsIn(4, 4), "a.png"), IsEmpty());
  EXPECT_THAT(
      notesOn(pixelsIn(4, 3), "a.png"),
      ElementsAre(HasSubstr("density: a.png: its 4 x 3 pixels are stretched over the domain, and come "
                            "out 1.33 times as high as wide")));
  EXPECT_THAT(
      notesOn(pixelsIn(4, 3), ""),
      ElementsAre("density: its 4 x 3 pixels are stretched over the domain, and come out 1.33 times as "
                  "high as wide; a density box says where they lie"));
}

TEST(DensityPlace, whatAPlaceLeavesEmptyIsSaid) {
  EXPECT_THAT(notesOn(pixelsIn(4, 3, Box{-1, -1, 11, 12}), "a.png"), IsEmpty());
  EXPECT_THAT(notesOn(pixelsIn(4, 3, Box{0, 0, 10, 10}), ""), IsEmpty());
  EXPECT_THAT(
      notesOn(pixelsIn(4, 3, Box{5, 0, 20, 10}), ""),
      ElementsAre("density: its pixels lie in 5,0,20,10 and cover 50 % of the domain 0,0,10,10; it is 0 "
                  "elsewhere"));
}

TEST(DensityPlace, aPlaceThatIsElsewhereIsRefused) {
  PlacedSites placed = inSquare();
  EXPECT_EQ(placeDensity(pixelsIn(4, 3, Box{50, 0, 60, 10}), "a.png", placed).error().message,
            "density: a.png: its pixels lie in 50,0,60,10, and nothing of the domain 0,0,10,10 does");
  EXPECT_THAT(placed.notes, IsEmpty());
}

TEST(DensityPlace, degreesAreNoPlaceInAPlaneAlsoWhereNothingSaysThatTheyAre) {
  PlacedSites placed = inSquare();
  placed.domain = {-80, -60, 80, 60};
  placed.projection = Projection::around({10, 50}).value();
  placed.longitudes = {9, 11};
  placed.latitudes = {49.5, 50.5};
  EXPECT_THAT(
      placeDensity(pixelsIn(4, 3, Box{9, 49, 11, 51}), "a.png", placed).error().message,
      AllOf(HasSubstr("a.png: its place 9,49,11,51 is in degrees"), HasSubstr("+lon_0=10 +lat_0=50")));
  EXPECT_TRUE(placeDensity(pixelsIn(4, 3, Box{-90, -90, 90, 90}), "a.png", placed));
}

TEST(DensityPlace, aPlaceInAnotherSystemIsRefused) {
  PlacedSites placed = inSquare();
  DensityFile density = pixelsIn(2, 2, Box{0, 0, 10, 10});
  density.system = systemOfCode(25833);
  EXPECT_THAT(placeDensity(density, "a.png", placed).error().message,
              HasSubstr("its place is in EPSG:25833, the sites in EPSG:25832"));
  density.system = systemOfCode(25832);
  EXPECT_TRUE(placeDensity(density, "a.png", placed));
  placed.projection = Projection::around({10, 50}).value();
  density.system = wgs84();
  EXPECT_THAT(placeDensity(density, "a.png", placed).error().message, HasSubstr("+lon_0=10 +lat_0=50"));
}

}  // namespace
}  // namespace vorpipe::test
