/// Which cell holds a place, against brute force and against the cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/sites/random_sites.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

Locator located(const Sites& sites, const CellsOptions& options) {
  auto locator = Locator::make(sites, options);
  EXPECT_TRUE(locator) << locator.error().message;
  return std::move(*locator);
}

std::vector<Point> somePlaces(std::size_t count, Random& random, const Box& box = {0, 0, 1, 1}) {
  std::vector<Point> places(count);
  for (Point& p : places) {
    p.x = box.xmin + random.uniform() * (box.xmax - box.xmin);
    p.y = box.ymin + random.uniform() * (box.ymax - box.ymin);
  }
  return places;
}

/// By how much a site's power at a place, or that of an image of it, is more than the least.
double missedBy(const Sites& sites, std::uint32_t found, Point p, const CellsOptions& options) {
  const bool across = options.periodic == Periodic::x || options.periodic == Periodic::xy;
  const bool up = options.periodic == Periodic::y || options.periodic == Periodic::xy;
  const Box& box = options.domain;
  const auto apart = [](double a, double b, bool repeats, double length) {
    const double way = a - b;
    return repeats ? way - length * std::nearbyint(way / length) : way;
  };
  const auto power = [&](std::size_t i) {
    const double x = apart(p.x, sites.x[i], across, box.xmax - box.xmin);
    const double y = apart(p.y, sites.y[i], up, box.ymax - box.ymin);
    return x * x + y * y - (sites.weight.empty() ? 0 : sites.weight[i]);
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sites.size(); ++i) least = std::min(least, power(i));
  return power(found) - least;
}

std::uint64_t newSeed() {
  const std::uint64_t seed = std::random_device{}();
  std::cout << "[   SEED   ] " << seed << std::endl;
  return seed;
}

TEST(Locator, findsTheNearestSiteByBruteForce) {
  const std::uint64_t seed = newSeed();
  Random random(seed);
  for (int run = 0; run < 24; ++run) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", run " << run);
    const Box box = run % 2 == 0 ? Box{0, 0, 1, 1} : Box{-300, 50, 500, 90};
    CellsOptions options = unit_cells;
    options.domain = box;
    options.periodic = static_cast<Periodic>(run % 4);
    Sites sites;
    for (const Point p : somePlaces(1 + random.below(300), random, box)) add(sites, p);
    const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
    if (run % 3 != 0) {
      const double most = (run % 3) * width * height / static_cast<double>(sites.size());
      for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(most * random.uniform());
    }
    const Locator locator = located(sites, options);
    for (const Point p : somePlaces(300, random, box)) {
      const auto site = locator.at(p);
      ASSERT_LT(site, sites.size());
      EXPECT_LE(missedBy(sites, site, p, options), 1e-12 * width * width) << p.x << ", " << p.y;
    }
  }
}

TEST(Locator, findsSitesBeyondTheDomain) {
  const Sites sites = mixedSites();
  EXPECT_EQ(located(sites, unit_cells).at({1, 0.5}), 201u);
}

TEST(Locator, findsManyPlacesAsItFindsOne) {
  Random random(3);
  const Sites sites = generate(Pattern::clusters, 20'000, 4);
  const Locator locator = located(sites, unit_cells);
  auto places = somePlaces(30'000, random, {-0.1, -0.1, 1.1, 1.1});
  const double infinite = std::numeric_limits<double>::infinity();
  places[3] = {infinite, 0.5};
  places[4] = {0.5, -infinite};
  places[5] = {infinite - infinite, infinite - infinite};
  std::vector<std::uint32_t> found(places.size());
  locator.at(places, found);
  for (std::size_t k = 0; k < places.size(); ++k) ASSERT_EQ(found[k], locator.at(places[k])) << k;
}

TEST(Locator, namesTheOwnerOfEqualSites) {
  const Sites sites{{0.5, 0.25, 0.25}, {0.5, 0.25, 0.25}, {}};
  EXPECT_EQ(located(sites, unit_cells).at({0.25, 0.2}), 1u);
  Sites heavier = sites;
  heavier.weight = {0, 0, 0.01};
  EXPECT_EQ(located(heavier, unit_cells).at({0.25, 0.2}), 2u);
  CellsOptions repeated = unit_cells;
  repeated.periodic = Periodic::xy;
  const Sites copies{{0.5, 1.25, 0.25}, {0.5, 0.25, -0.75}, {}};
  EXPECT_EQ(located(copies, repeated).at({0.25, 0.2}), 1u);
}

TEST(Locator, givesPlacesBetweenSitesToTheFirst) {
  const Sites corners{{0.75, 0.25, 0.75, 0.25}, {0.75, 0.25, 0.25, 0.75}, {}};
  const Locator locator = located(corners, unit_cells);
  EXPECT_EQ(locator.at({0.5, 0.5}), 0u);
  EXPECT_EQ(locator.at({0.5, 0.25}), 1u);
  EXPECT_EQ(locator.at({0.5, 0.75}), 0u);
  EXPECT_EQ(locator.at({0.75, 0.5}), 0u);
  EXPECT_EQ(locator.at({std::nextafter(0.75, 1.0), std::nextafter(0.5, 0.0)}), 2u);
}

TEST(Locator, hasTheSidesOfTheDomainAndNothingBeyond) {
  const Locator locator = located(generate(Pattern::random, 100, 1), unit_cells);
  const double beyond = std::nextafter(1.0, 2.0), nan = std::numeric_limits<double>::quiet_NaN();
  for (const Point p : {Point{0, 0}, {1, 1}, {1, 0}, {0.5, 1}}) EXPECT_NE(locator.at(p), no_site);
  for (const Point p :
       {Point{beyond, 0.5}, {0.5, beyond}, {-1e-300, 0.5}, {nan, 0.5}, {0.5, nan}, {1e300, 0}}) {
    EXPECT_EQ(locator.at(p), no_site) << p.x << ", " << p.y;
  }
}

TEST(Locator, takesPlacesBeyondAPeriodicDomainIntoIt) {
  CellsOptions options = unit_cells;
  options.periodic = Periodic::x;
  Random random(5);
  const Locator locator = located(generate(Pattern::random, 500, 1), options);
  for (const Point p : somePlaces(200, random, {0, 0, 0.5, 1})) {
    const Point exact{std::ldexp(std::floor(std::ldexp(p.x, 30)), -30), p.y};
    for (const double periods : {-7.0, -1.0, 1.0, 1e6}) {
      EXPECT_EQ(locator.at({exact.x + periods, exact.y}), locator.at(exact));
    }
  }
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Point p : {Point{0.5, 1.5}, {0x1p52, 0.5}, {infinite, 0.5}}) EXPECT_EQ(locator.at(p), no_site);
  EXPECT_NE(locator.at({-0x1p49, 0.5}), no_site);
}

TEST(Locator, isEmptyBeyondAnOutline) {
  Random random(6);
  const Outline outline = country(1000);
  const Sites sites = generate(Pattern::random, 300, 2);
  const Locator locator = located(sites, inside(outline)), box = located(sites, unit_cells);
  const auto places = somePlaces(20'000, random);
  std::size_t in = 0;
  for (const Point p : places) {
    const auto site = locator.at(p);
    in += site != no_site ? 1u : 0u;
    EXPECT_TRUE(site == no_site || site == box.at(p));
  }
  EXPECT_NEAR(static_cast<double>(in) / static_cast<double>(places.size()), outlineArea(outline), 0.02);
  const Locator frame =
      located(sites, inside(outlineOf({{rectangle(-1, -1, 0.75, 2), rectangle(0.25, 0.25, 0.5, 0.5)}})));
  EXPECT_NE(frame.at({0.1, 0.1}), no_site);
  for (const Point p : {Point{0.3, 0.3}, {0.8, 0.5}, {-0.5, 0.5}}) EXPECT_EQ(frame.at(p), no_site);
}

TEST(Locator, theBorderOfAnOutlineBelongsToIt) {
  const Sites sites = generate(Pattern::random, 300, 2);
  const Outline with_hole =
      outlineOf({{rectangle(0.1, 0.1, 0.9, 0.8), {{0.3, 0.3}, {0.7, 0.3}, {0.5, 0.5}}}});
  for (const Outline& outline : {country(1000), with_hole}) {
    const Locator locator = located(sites, inside(outline));
    for (const Point corner : outline.points) EXPECT_NE(locator.at(corner), no_site);
  }
  const Locator locator = located(sites, inside(with_hole));
  for (const Point p : {Point{0.1, 0.5}, {0.9, 0.5}, {0.5, 0.1}, {0.5, 0.8}, {0.5, 0.3}}) {
    EXPECT_NE(locator.at(p), no_site);
  }
  for (const Point p : {Point{0.1 - 1e-15, 0.5}, {0.9 + 1e-15, 0.5}, {0.5, 0.3 + 1e-15}}) {
    EXPECT_EQ(locator.at(p), no_site);
  }
}

TEST(Locator, findsTheCellThatHoldsItsCentroid) {
  for (const auto pattern : {Pattern::random, Pattern::hex, Pattern::clusters, Pattern::circle}) {
    const Sites sites = generate(pattern, 3000, 9);
    const Diagram diagram = cellsOf(sites, unit_cells);
    const Locator locator = located(sites, unit_cells);
    for (const Cell cell : diagram) {
      EXPECT_TRUE(cell.area() < 1e-12 || locator.at(cell.centroid()) == cell.index());
    }
  }
}

TEST(Locator, decidesAsPicturesDo) {
  RenderOptions picture{};
  picture.domain = {3, 1, 4, 2};
  picture.width = picture.height = 128;
  // Every other column and row of pixel centers lies on bisectors.
  Sites sites;
  for (int k = 0; k < 64; ++k) {
    add(sites, {3 + (k % 8 * 16 + 8.5) / 128, 1 + (std::floor(k / 8.0) * 16 + 8.5) / 128});
  }
  const auto rendering = cpuSession().render(sites, picture);
  ASSERT_TRUE(rendering);
  const Locator locator = located(sites, cellsOptions(picture));
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      const Point center{3 + (column + 0.5) / 128, 2 - (row + 0.5) / 128};
      ASSERT_EQ(locator.at(center), rendering->image.ids[static_cast<std::size_t>(row * 128 + column)])
          << row << ", " << column;
    }
  }
}

TEST(Locator, refusesWhatRunsRefuse) {
  const Sites sites = generate(Pattern::random, 10, 1);
  const auto message = [](const Sites& refused, const CellsOptions& options) {
    const auto locator = Locator::make(refused, options);
    EXPECT_FALSE(locator);
    return locator ? std::string{} : locator.error().message;
  };
  EXPECT_EQ(message({}, unit_cells), "there are no sites");
  CellsOptions flat = unit_cells;
  flat.domain = {0, 0, 1, 0};
  EXPECT_THAT(message(sites, flat), testing::HasSubstr("is not a rectangle"));
  EXPECT_THAT(message(sites, inside(outlineOf({{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}}))),
              testing::HasSubstr("outline"));
}

}  // namespace
}  // namespace vorpipe::test
