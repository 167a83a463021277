#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "domain/degrees.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

/// The area of the ellipsoid between two parallels and two meridians, in closed form; km2.
double areaOnEllipsoid(const Box& degrees) {
  constexpr double a = 6378.137, f = 1 / 298.257223563, e2 = f * (2 - f);
  const double e = std::sqrt(e2);
  const auto q = [&](double latitude) {
    const double sine = std::sin(latitude * degree);
    return (1 - e2) * (sine / (1 - e2 * sine * sine) + std::atanh(e * sine) / e);
  };
  return a * a / 2 * (degrees.xmax - degrees.xmin) * degree * (q(degrees.ymax) - q(degrees.ymin));
}

Sites randomSites(const Box& box, std::size_t count, std::uint64_t seed) {
  Sites sites = generate(Pattern::random, count, seed);
  for (double& x : sites.x) x = box.xmin + x * (box.xmax - box.xmin);
  for (double& y : sites.y) y = box.ymin + y * (box.ymax - box.ymin);
  return sites;
}

/// The cells of sites in degrees, in the plane around a center, inside a box in degrees.
Diagram cellsOnEarth(const Sites& sites, const Box& box, const Projection& projection) {
  const Outline degrees = outlineOfDegrees(box).value();
  const Outline plane = toPlane(projection, degrees).value();
  const Sites there = toPlane(projection, sites).value();
  const CellsOptions options = inside(plane, boxOf(plane.points));
  Diagram diagram = cellsOf(there, options);
  EXPECT_THAT(promisesOf(check(there, options, diagram)), testing::IsEmpty());
  toDegrees(projection, turned(projection, sites), diagram);
  return diagram;
}

Diagram cellsOnEarth(const Sites& sites, const Box& box) {
  return cellsOnEarth(sites, box, projectionAmid(outlineOfDegrees(box).value()).value());
}

std::set<std::int64_t> neighborSet(const Diagram& diagram, std::size_t site) {
  const auto neighbors = diagram.cell(site).neighbors();
  std::set<std::int64_t> sites;
  std::ranges::copy_if(neighbors, std::inserter(sites, sites.end()),
                       [](std::int64_t n) { return !isWall(n); });
  return sites;
}

TEST(Maps, centersLieAmidPlaces) {
  const auto center = [](const std::vector<double>& x, const std::vector<double>& y) {
    return projectionAmid(Sites{x, y, {}}).value().center();
  };
  EXPECT_EQ(center({10, 14}, {0, 0}), (Point{12, 0}));
  EXPECT_EQ(center({178, -178}, {-5, 5}), (Point{180, 0}));
  EXPECT_EQ(center({350, 10}, {20, 20}).x, 0);
  EXPECT_EQ(center({0, 90, 180, -90}, {70, 70, 70, 70}).y, 90);
  EXPECT_EQ(center({0, 90, 180, -90}, {-80, -80, -80, -80}).y, -90);
}

// The equator is the border of both hemispheres.
TEST(Maps, hemispheresAreAroundTheirPoles) {
  const auto centerOf = [](const Box& box) {
    return projectionAmid(outlineOfDegrees(box).value())->center();
  };
  EXPECT_EQ(centerOf({-180, 0, 180, 90}), (Point{0, 90}));
  EXPECT_EQ(centerOf({-180, -90, 180, 0}), (Point{0, -90}));
  Outline west;
  for (const Point place : {Point{0, -90}, Point{0, 0}, Point{0, 90}, Point{180, 0}})
    west.points.push_back(place);
  west.ring_offsets = {0, 4};
  west.polygon_offsets = {0, 1};
  EXPECT_EQ(projectionAmid(west)->center(), (Point{-90, 0}));
}

TEST(Maps, placesThatAreNoneAreRefused) {
  for (const Point bad : {Point{0, 91}, Point{400, 0}, Point{std::nan(""), 0}, Point{0, std::nan("")}}) {
    const auto amid = projectionAmid(Sites{{1, bad.x}, {2, bad.y}, {}});
    ASSERT_FALSE(amid);
    EXPECT_EQ(amid.error().subject, Subject::sites);
    EXPECT_THAT(amid.error().message, testing::HasSubstr("site 1 at"));
    EXPECT_FALSE(toPlane(Projection::around({0, 0}).value(), Sites{{1, bad.x}, {2, bad.y}, {}}));
  }
  for (const Box& bad :
       {Box{0, 0, 1, 91}, Box{-400, 0, 0, 1}, Box{-180, -90, 180, 90}, Box{-200, 0, 200, 1}}) {
    EXPECT_FALSE(outlineOfDegrees(bad));
  }
  for (const Box& around : {Box{-180, -5, 180, 5}, Box{0, -1, 360, 60}, Box{-180, -90, 180, 1e-9}}) {
    const auto outline = outlineOfDegrees(around);
    ASSERT_FALSE(outline);
    EXPECT_THAT(outline.error().message, testing::HasSubstr("on both sides of the equator"));
  }
}

TEST(Maps, boxesInDegreesHaveTheirAreaOnTheEllipsoid) {
  for (const Box& box : {Box{5, 47, 15, 55},
                         {170, -50, 190, -30},
                         {-10, -10, 10, 10},
                         {-180, 60, 180, 90},
                         {-180, 60, 180, 80},
                         {-180, -90, 180, -65},
                         {-180, -90, 180, 0},
                         {0, 0, 360, 90},
                         {30, 80, 60, 90},
                         {12, 41, 12.01, 41.01}}) {
    SCOPED_TRACE(fmt::format("{},{},{},{}", box.xmin, box.ymin, box.xmax, box.ymax));
    const Outline degrees = outlineOfDegrees(box).value();
    const Outline plane = toPlane(projectionAmid(degrees).value(), degrees).value();
    const auto whole = mended(plane, true);
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_NEAR(outlineArea(whole->outline), areaOnEllipsoid(box), 1e-5 * areaOnEllipsoid(box));
  }
}

TEST(Maps, areasOfCellsAddUpToThatOnTheEllipsoid) {
  const Box box{5, 47, 15, 55};
  const Diagram diagram = cellsOnEarth(randomSites(box, 300, 3), box);
  EXPECT_NEAR(areaSum(diagram), areaOnEllipsoid(box), 1e-5 * areaOnEllipsoid(box));
  for (const Point vertex : diagram.vertices) {
    EXPECT_TRUE(vertex.x > 5 - 1e-6 && vertex.x < 15 + 1e-6 && vertex.y > 47 - 1e-3 && vertex.y < 55 + 1e-3)
        << vertex.x << ", " << vertex.y;
  }
}

TEST(Maps, sitesWithoutACellAreWhereTheyWere) {
  Sites sites = randomSites({5, 47, 15, 55}, 50, 3);
  sites.x.insert(sites.x.end(), {-70.123, 170, sites.x[0]});
  sites.y.insert(sites.y.end(), {-33.321, -80, sites.y[0]});
  const Diagram diagram = cellsOnEarth(sites, {5, 47, 15, 55});
  EXPECT_EQ(diagram.centroid[50], (Point{-70.123, -33.321}));
  EXPECT_EQ(diagram.centroid[51], (Point{170, -80}));
  EXPECT_EQ(diagram.centroid[52], (Point{sites.x[0], sites.y[0]}));
}

TEST(Maps, theAntimeridianAndThePolesAreNoBorders) {
  const Box here{5, 47, 15, 55}, there{175, 47, 185, 55};
  const Sites sites = randomSites(here, 300, 3);
  Sites moved = sites;
  for (double& x : moved.x) x = std::remainder(x + 170, 360);
  const Diagram a = cellsOnEarth(sites, here, Projection::around({10, 51}).value());
  const Diagram b = cellsOnEarth(moved, there, Projection::around({180, 51}).value());
  std::size_t differ = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(a.area[i], b.area[i], 1e-6 * a.area[i]);
    EXPECT_NEAR(b.centroid[i].x, a.centroid[i].x + 170, 1e-8);
    EXPECT_NEAR(b.centroid[i].y, a.centroid[i].y, 1e-8);
    differ += neighborSet(a, i) == neighborSet(b, i) ? 0U : 1U;
  }
  EXPECT_EQ(differ, 0u);
  const Sites same = turned(Projection::around({180, 51}).value(), moved);
  for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_NEAR(same.x[i], sites.x[i] + 170, 1e-12);
  const Box cap{-180, 70, 180, 90};
  EXPECT_NEAR(areaSum(cellsOnEarth(randomSites(cap, 100, 4), cap)), areaOnEllipsoid(cap),
              1e-5 * areaOnEllipsoid(cap));
}

/// The longitudes of a ring, from each vertex to the next.
std::vector<double> stepsOf(const Diagram& diagram, std::size_t site) {
  const auto ring = diagram.cell(site).vertices();
  std::vector<double> steps;
  for (std::size_t k = 0; k < ring.size(); ++k) steps.push_back(ring[(k + 1) % ring.size()].x - ring[k].x);
  return steps;
}

TEST(Maps, longitudesAreContinuousAlongRingsAroundEitherPole) {
  for (const double pole : {90.0, -90.0}) {
    SCOPED_TRACE(pole);
    const double latitude = pole / 6 * 5;
    const Sites sites{{0, 45, 90, 135, 180, 225, 270, 315, 0},
                      {latitude, latitude, latitude, latitude, latitude, latitude, latitude, latitude, pole},
                      {}};
    const Box cap = pole > 0 ? Box{-180, 60, 180, 90} : Box{-180, -90, 180, -60};
    const Diagram diagram = cellsOnEarth(sites, cap);
    const Sites shown = turned(projectionAmid(outlineOfDegrees(cap).value()).value(), sites);
    EXPECT_EQ(shown.x[4], 180);
    for (std::size_t i = 0; i < 8; ++i) {
      const auto [west, east] = std::ranges::minmax(diagram.cell(i).vertices(), {}, &Point::x);
      EXPECT_NEAR(west.x, shown.x[i] - 22.5, 1e-6) << i;
      EXPECT_NEAR(east.x, shown.x[i] + 22.5, 1e-6) << i;
      EXPECT_NEAR(diagram.centroid[i].x, shown.x[i], 1e-6) << i;
      for (const double step : stepsOf(diagram, i)) EXPECT_LT(std::abs(step), 180) << i;
    }
    // Around the pole one edge leads from the last longitude to the first.
    const auto steps = stepsOf(diagram, 8);
    EXPECT_EQ(std::ranges::count_if(steps, [](double step) { return std::abs(step) > 180; }), 1);
  }
}

TEST(Maps, ringsThatAreLedToAPoleMayBeginAnywhere) {
  std::vector<Point> ring{{-180, -90}, {-180, -70}, {-90, -72}, {0, -68}, {90, -66}, {180, -70}, {180, -90}};
  double first = 0;
  for (std::size_t turn = 0; turn < ring.size(); ++turn) {
    const Outline degrees{ring, {0, ring.size()}, {0, 1}};
    const auto plane = mendedToPlane(Projection::around({0, -90}).value(), degrees, false);
    ASSERT_TRUE(plane) << turn << ": " << plane.error().message;
    const double area = outlineArea(plane->outline);
    if (turn == 0) first = area;
    EXPECT_NEAR(area, first, 1e-9 * first) << turn;
    std::ranges::rotate(ring, ring.begin() + 1);
  }
  EXPECT_GT(first, 1e7);
}

TEST(Maps, cellsOnBothSidesOfTheMeridianShareTheirVerticesInThePlane) {
  const Box box{-180, 60, 180, 90};
  const Sites sites = randomSites(box, 40, 5);
  const Outline degrees = outlineOfDegrees(box).value();
  const Projection projection = projectionAmid(degrees).value();
  const Outline plane = toPlane(projection, degrees).value();
  Diagram diagram = cellsOf(toPlane(projection, sites).value(), inside(plane, boxOf(plane.points)));
  Topology topology = topologyOf(diagram).value();
  toDegrees(projection, turned(projection, sites), diagram);
  toDegrees(projection, topology);
  for (std::size_t entry = 0; entry < diagram.vertices.size(); ++entry) {
    const Point shared = topology.vertices[topology.vertex_of[entry]], own = diagram.vertices[entry];
    EXPECT_EQ(own.y, shared.y);
    EXPECT_NEAR(std::remainder(own.x - shared.x, 360), 0, 1e-9);
  }
}

// In central Europe a degree of longitude is some 0.63 of one of latitude.
TEST(Maps, degreesTakenForAPlaneGiveOneSiteInSixOtherNeighbors) {
  const Box box{5, 47, 15, 55};
  const Sites sites = randomSites(box, 2000, 1);
  const Diagram projected = cellsOnEarth(sites, box);
  const Diagram flat = cellsOf(sites, CellsOptions{box, {}, Periodic::none, {}, {}, Detail::measures, {}});
  std::size_t pairs = 0, lost = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto there = neighborSet(projected, i);
    for (const auto neighbor : neighborSet(flat, i)) {
      ++pairs;
      lost += there.contains(neighbor) ? 0U : 1U;
    }
  }
  EXPECT_NEAR(static_cast<double>(lost) / static_cast<double>(pairs), 0.16, 0.02);
}

TEST(Maps, outlinesThatShareASideInDegreesShareItInThePlane) {
  const Outline degrees = outlineOf({{rectangle(0, 40, 10, 60)}, {{{10, 40}, {20, 40}, {20, 60}, {10, 60}}}});
  const Outline plane = toPlane(projectionAmid(degrees).value(), degrees).value();
  const auto whole = mended(plane, false);
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->outline.polygon_offsets.size(), 2u);
  EXPECT_EQ(whole->outline.ring_offsets.size(), 2u);
  // As a file has a country that it cuts at the antimeridian.
  const Outline halves = outlineOf({{rectangle(170, 60, 180, 70)}, {rectangle(-180, 60, -170, 70)}});
  const auto country = mended(toPlane(projectionAmid(halves).value(), halves).value(), false);
  ASSERT_TRUE(country) << country.error().message;
  EXPECT_EQ(country->outline.ring_offsets.size(), 2u);
  EXPECT_NEAR(outlineArea(country->outline), areaOnEllipsoid({170, 60, 190, 70}), 10);
}

TEST(Maps, ringsMayCrossTheAntimeridianEndAtItOrGoAlongItToAPole) {
  const auto areaOf = [](const Outline& degrees) {
    const auto plane = mendedToPlane(projectionAmid(degrees).value(), degrees, false);
    EXPECT_TRUE(plane) << plane.error().message;
    return plane ? outlineArea(plane->outline) : 0;
  };
  const double wide = areaOnEllipsoid({170, 60, 190, 70}), cap = areaOnEllipsoid({-180, 70, 180, 90});
  EXPECT_NEAR(areaOf(outlineOf({{rectangle(170, 60, 190, 70)}})), wide, 1e-5 * wide);
  EXPECT_NEAR(areaOf(outlineOf({{{{170, 60}, {-170, 60}, {-170, 70}, {170, 70}}}})), wide, 1e-5 * wide);
  EXPECT_NEAR(areaOf(outlineOf({{rectangle(170, 60, 180, 70)}, {rectangle(-180, 60, -170, 70)}})), wide,
              1e-5 * wide);
  EXPECT_NEAR(areaOf(outlineOf({{rectangle(-180, 70, 180, 90)}})), cap, 1e-5 * cap);
  RingPoints around;
  for (int x = -170; x < 180; x += 10) around.push_back({static_cast<double>(x), 70});
  EXPECT_NEAR(areaOf(outlineOf({{around}})), cap, 1e-5 * cap);
  // A ring that crosses itself in degrees is named by its place there.
  const Outline bow = outlineOf({{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}});
  const auto refused = mendedToPlane(projectionAmid(bow).value(), bow, false);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("at (0.5, 0.5)"));
  EXPECT_TRUE(mendedToPlane(projectionAmid(bow).value(), bow, true));
  // One across the antimeridian as well, which is looked at in the plane.
  const Outline across = outlineOf({{{{170, 80}, {-170, 82}, {-170, 80}, {170, 82}}}});
  EXPECT_THAT(mendedToPlane(projectionAmid(across).value(), across, false).error().message,
              testing::HasSubstr("at (180, 8"));
  EXPECT_THAT(mendedToPlane(projectionAmid(across).value(), across, true)->changes,
              testing::AllOf(testing::HasSubstr("at (180, 8"), testing::HasSubstr(" km2")));
}

TEST(Maps, domainsReachAQuarterOfTheEarthAtMost) {
  EXPECT_NEAR(reachOf(Box{-1, -1, 1, 1}).value(), 0.0127, 1e-3);
  const Outline degrees = outlineOfDegrees(Box{-30, -1, 30, 1}).value();
  EXPECT_NEAR(reachOf(toPlane(projectionAmid(degrees).value(), degrees).value()).value(), 30, 0.1);
  const auto far = reachOf(Box{-9000, -9000, 9000, 9000});
  ASSERT_FALSE(far);
  EXPECT_THAT(far.error().message, testing::HasSubstr("degrees from the center"));
  EXPECT_NEAR(distortionAt(30), 0.035, 1e-3);
}

TEST(Maps, marginsGrowTheDomainOfSites) {
  const Sites sites{{0, 10}, {0, 4}, {}};
  const auto corners = [&](const Margin& margin) {
    const Box box = domainOf(sites, margin);
    return std::vector<double>{box.xmin, box.ymin, box.xmax, box.ymax};
  };
  EXPECT_THAT(corners({0.1, true}), testing::ElementsAre(-1, -1, 11, 5));
  EXPECT_THAT(corners({3, false}), testing::ElementsAre(-3, -3, 13, 7));
  EXPECT_THAT(corners({0, true}), testing::ElementsAre(0, 0, 10, 4));
  EXPECT_THAT(corners({}), testing::ElementsAre(-0.5, -0.5, 10.5, 4.5));
}

}  // namespace
}  // namespace vorpipe::test
