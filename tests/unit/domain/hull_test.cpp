#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/predicates.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

TEST(Hull, noSiteLiesBeyondItAndItsCornersAreSites) {
  const Sites sites = generate(Pattern::clusters, 5000, 4);
  const auto hull = hullOf(sites, 0);
  ASSERT_TRUE(hull) << hull.error().message;
  const double side = ringArea(hull->points) > 0 ? 1 : -1;
  for (std::size_t k = 0; k < hull->points.size(); ++k) {
    const Point a = hull->points[k], b = hull->points[(k + 1) % hull->points.size()];
    bool is_site = false;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const Point p{sites.x[i], sites.y[i]};
      is_site = is_site || p == a;
      ASSERT_GE(side * core::orientation(a, b, p), 0) << "site " << i << " beyond side " << k;
    }
    EXPECT_TRUE(is_site) << "corner " << k;
  }
  EXPECT_TRUE(checkInput(sites, inside(*hull)));
}

TEST(Hull, growsByItsMarginOnEverySide) {
  const auto hull = hullOf(Sites{{0, 2, 2, 0, 1}, {0, 0, 1, 1, 0.5}, {}}, 0.5);
  ASSERT_TRUE(hull) << hull.error().message;
  EXPECT_NEAR(std::abs(ringArea(hull->points)), 3 * 2, 1e-12);
  const Box box = boxOf(hull->points);
  EXPECT_DOUBLE_EQ(box.xmin, -0.5);
  EXPECT_DOUBLE_EQ(box.ymax, 1.5);
}

TEST(Hull, ofSitesOnALineTakesAMargin) {
  for (const Sites& sites : {Sites{{1, 2}, {1, 2}, {}}, Sites{{1, 2, 3}, {1, 2, 3}, {}}}) {
    const auto line = hullOf(sites, 0);
    ASSERT_FALSE(line);
    EXPECT_EQ(line.error().subject, Subject::outline);
    EXPECT_THAT(line.error().message, testing::HasSubstr("no area"));
    const auto grown = hullOf(sites, 1);
    ASSERT_TRUE(grown) << grown.error().message;
    const double length = std::hypot(sites.x.back() - sites.x.front(), sites.y.back() - sites.y.front());
    EXPECT_NEAR(std::abs(ringArea(grown->points)), 2 * (length + 2), 1e-12);
  }
}

TEST(Hull, inOnePlaceThereIsNone) {
  for (const Sites& sites : {Sites{{1}, {1}, {}}, Sites{{5, 5, 5, 5}, {5, 5, 5, 5}, {}}}) {
    const auto hull = hullOf(sites, 1);
    ASSERT_FALSE(hull);
    EXPECT_EQ(hull.error().subject, Subject::outline);
    EXPECT_THAT(hull.error().message, testing::HasSubstr("no area"));
  }
}

TEST(Hull, isRefusedWhereNumbersAreNone) {
  EXPECT_FALSE(hullOf(Sites{{0, 1, 0}, {0, 0, 1}, {}}, -1));
  EXPECT_FALSE(hullOf(Sites{{0, 1, std::nan("")}, {0, 0, 1}, {}}, 0));
}

// GEOS 3.11 returns an empty buffer for these sites, which hullOf refuses; GEOS 3.13 returns the hull.
TEST(Hull, isRefusedOrRightWhereItsMarginIsLostInCoordinatesThatAreTooLarge) {
  const Sites sites = {{9.6e149, 5.7e148, 8.4e149, 6.7e149, 6.1e149, 5.8e149},
                       {9.5e149, 8.5e148, 7.4e149, 3.1e149, 6.1e149, 1.6e149},
                       {}};
  const auto hull = hullOf(sites, 1);
  if (hull) {
    const auto without_margin = hullOf(sites, 0);
    ASSERT_TRUE(without_margin) << without_margin.error().message;
    EXPECT_NEAR(ringArea(hull->points) / ringArea(without_margin->points), 1, 1e-12);
  } else {
    EXPECT_THAT(hull.error().message, testing::HasSubstr("no area in GEOS: scale the sites"));
  }
}

}  // namespace
}  // namespace vorpipe::test
