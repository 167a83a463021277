#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <vector>

#include "domain/degrees.h"
#include "unit/fixtures/temporary_directory.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

Projection around(Point center) {
  auto projection = Projection::around(center);
  EXPECT_TRUE(projection) << projection.error().message;
  return *projection;
}

constexpr std::array<Point, 9> centers = {{{12.6, 41.84},
                                           {0, 0},
                                           {179, -40},
                                           {-179.5, 60},
                                           {30, 89.5},
                                           {0, 90},
                                           {-100, -90},
                                           {10, 1e-6},
                                           {190, 5}}};

/// Places some 3000 km around a center.
std::vector<Point> placesAround(Point center, std::size_t count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Point> places;
  while (places.size() < count) {
    const double latitude = center.y + 25 * uniform(random);
    if (std::abs(latitude) > 90) continue;
    const double wide = 12 / std::max(std::cos(latitude * degree), 0.07);
    places.push_back({center.x + wide * uniform(random), latitude});
  }
  return places;
}

TEST(Projection, theCenterIsTheOriginAndThereAndBackChangesNothing) {
  for (const Point center : centers) {
    SCOPED_TRACE(fmt::format("{}, {}", center.x, center.y));
    const Projection projection = around(center);
    EXPECT_EQ(projection.center(), center);
    EXPECT_EQ(projection.toPlane(center), (Point{0, 0}));
    EXPECT_NEAR(projection.toDegrees({0, 0}).x, center.x, 1e-12);
    EXPECT_NEAR(projection.toDegrees({0, 0}).y, center.y, 1e-12);
    for (const Point place : placesAround(center, 2000)) {
      const Point back = projection.toDegrees(projection.toPlane(place));
      EXPECT_NEAR(back.y, place.y, 1e-12);
      EXPECT_NEAR(std::remainder(back.x - place.x, 360) * std::cos(place.y * degree), 0, 1e-12);
      EXPECT_LE(std::abs(back.x - center.x), 180 + 1e-12);
    }
  }
}

TEST(Projection, turnsOfLongitudeAreTheSamePlaces) {
  for (const Point center : {Point{97.33, 61.7}, Point{0, 10}, Point{-180, 0}}) {
    const Projection projection = around(center);
    for (const double latitude : {-80.0, 0.1, 66.6}) {
      EXPECT_EQ(projection.toPlane({180, latitude}), projection.toPlane({-180, latitude}));
      EXPECT_EQ(projection.toPlane({-10.5, latitude}), projection.toPlane({349.5, latitude}));
    }
    EXPECT_EQ(projection.toPlane({12, 90}), projection.toPlane({-34, 90}));
  }
}

TEST(Projection, theWholeEarthHasAPlaceAndNothingIsBeyondIt) {
  for (const Point center : centers) {
    const Projection projection = around(center);
    const Point antipode = projection.toPlane({center.x + 180, -center.y});
    EXPECT_NEAR(std::hypot(antipode.x, antipode.y), 12742, 20);
    EXPECT_TRUE(std::isfinite(projection.toDegrees(antipode).x));
    EXPECT_NEAR(projection.toDegrees(antipode).y, -center.y, 1e-5);
    EXPECT_TRUE(std::isnan(projection.toDegrees({10000, 10000}).x));
    EXPECT_TRUE(std::isnan(projection.toDegrees({10000, 10000}).y));
  }
}

TEST(Projection, refusesCentersThatAreNoPlaces) {
  const double nan = std::nan("");
  for (const Point center : {Point{0, 90.1}, Point{361, 0}, Point{nan, 0}, Point{0, nan}}) {
    const auto projection = Projection::around(center);
    ASSERT_FALSE(projection);
    EXPECT_EQ(projection.error().code, ErrorCode::input);
  }
}

// By PROJ 9.1.1: +proj=laea +lat_0=41.84 +lon_0=12.6 +datum=WGS84 +units=km.
TEST(Projection, agreesWithKnownPlaces) {
  const Projection projection = around({12.6, 41.84});
  struct Known {
    Point degrees, plane;
  };
  const std::array<Known, 3> known = {{{{12.4964, 41.9028}, {-8.59639793618347, 6.98040731739773}},
                                       {{7.5, 47.25}, {-386.228350414145, 612.65406300576}},
                                       {{-10, 60}, {-1253.95732418502, 2192.90976693712}}}};
  for (const auto& [degrees, plane] : known) {
    EXPECT_NEAR(projection.toPlane(degrees).x, plane.x, 1e-9);
    EXPECT_NEAR(projection.toPlane(degrees).y, plane.y, 1e-9);
  }
}

class ProjectionByProj : public InTemporaryDirectory {};

TEST_F(ProjectionByProj, isTheSameWithinAMillimeter) {
  if (std::system("gdaltransform --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "there is no gdaltransform";
  for (const Point center : centers) {
    const auto places = placesAround(center, 500);
    std::string text;
    for (const Point place : places) text += fmt::format("{} {}\n", place.x, place.y);
    const std::string in = write("places.txt", text), out = in + ".out";
    const std::string command = fmt::format(
        "gdaltransform -output_xy -s_srs '+proj=longlat +datum=WGS84' -t_srs '+proj=laea +lat_0={} +lon_0={} "
        "+datum=WGS84 +units=km' <{} >{}",
        center.y, center.x, in, out);
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    const Projection projection = around(center);
    std::ifstream file(out);
    for (const Point place : places) {
      Point theirs{};
      ASSERT_TRUE(file >> theirs.x >> theirs.y);
      const Point ours = projection.toPlane(place);
      EXPECT_NEAR(ours.x, theirs.x, 1e-6) << place.x << ", " << place.y;
      EXPECT_NEAR(ours.y, theirs.y, 1e-6) << place.x << ", " << place.y;
    }
  }
}

}  // namespace
}  // namespace vorpipe::test
