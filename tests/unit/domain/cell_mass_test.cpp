#include "domain/cell_mass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {

using namespace core;

namespace {

Density randomDensity(int width, int height, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Density density{width, height, {}};
  for (int k = 0; k < width * height; ++k)
    density.values.push_back(uniform(random) < 0.2 ? 0 : uniform(random));
  return density;
}

CellsOptions under(const Density& density, const Box& domain = {0, 0, 1, 1}) {
  CellsOptions options{};
  options.domain = domain;
  options.density = density;
  return options;
}

struct LongPoint {
  long double x, y;
};

/// The part of a ring on one side of a line along an axis.
std::vector<LongPoint> cut(const std::vector<LongPoint>& ring, bool along_x, long double line, int side) {
  std::vector<LongPoint> kept;
  const auto beyond = [&](LongPoint p) { return side * ((along_x ? p.x : p.y) - line); };
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LongPoint a = ring[k], b = ring[(k + 1) % ring.size()];
    const long double at_a = beyond(a), at_b = beyond(b);
    if (at_a <= 0) kept.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
      const long double t = at_a / (at_a - at_b);
      kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return kept;
}

struct Mass {
  long double mass = 0, x = 0, y = 0;
};

/// Pixel by pixel: each ring clipped to it, holes taken away.
Mass byClipping(const Diagram& d, std::size_t cell, const Density& density, const Box& domain) {
  Mass sum;
  const auto bounds = d.ring_starts.empty()
                          ? std::vector<std::uint64_t>{d.cell_offsets[cell], d.cell_offsets[cell + 1]}
                          : ringBounds(d, cell);
  const long double dx = (static_cast<long double>(domain.xmax) - domain.xmin) / density.width;
  const long double dy = (static_cast<long double>(domain.ymax) - domain.ymin) / density.height;
  for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
    std::vector<LongPoint> ring;
    long double low[2] = {1e30L, 1e30L}, high[2] = {-1e30L, -1e30L};
    for (auto v = bounds[r]; v < bounds[r + 1]; ++v) {
      ring.push_back({(d.vertices[v].x - domain.xmin) / dx, (d.vertices[v].y - domain.ymin) / dy});
      low[0] = std::min(low[0], ring.back().x);
      high[0] = std::max(high[0], ring.back().x);
      low[1] = std::min(low[1], ring.back().y);
      high[1] = std::max(high[1], ring.back().y);
    }
    if (ring.empty()) continue;
    for (auto row = std::lround(std::floor(low[1])); static_cast<long double>(row) < high[1]; ++row) {
      auto strip = cut(cut(ring, false, static_cast<long double>(row + 1), 1), false,
                       static_cast<long double>(row), -1);
      for (auto column = std::lround(std::floor(low[0])); static_cast<long double>(column) < high[0];
           ++column) {
        const auto part = cut(cut(strip, true, static_cast<long double>(column + 1), 1), true,
                              static_cast<long double>(column), -1);
        const auto at_row = ((row % density.height) + density.height) % density.height;
        const auto at_column = ((column % density.width) + density.width) % density.width;
        const long double value =
            density
                .values[static_cast<std::size_t>((density.height - 1 - at_row) * density.width + at_column)];
        if (part.empty()) continue;
        const LongPoint o = part[0];
        for (std::size_t k = 0; k < part.size(); ++k) {
          const LongPoint a = part[k], b = part[(k + 1) % part.size()];
          const long double twice = (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
          sum.mass += value * twice / 2;
          sum.x += value * twice / 6 * (o.x + a.x + b.x);
          sum.y += value * twice / 6 * (o.y + a.y + b.y);
        }
      }
    }
  }
  if (sum.mass > 0)
    sum = {sum.mass * dx * dy, domain.xmin + sum.x / sum.mass * dx, domain.ymin + sum.y / sum.mass * dy};
  return sum;
}

/// The oracle takes vertices as they are: ties moved these by `moved`, but nothing of masses.
void expectAsClipped(const Sites& sites, const CellsOptions& options, double moved = 0) {
  const Diagram d = cellsOf(sites, options);
  const Density& density = options.density;
  const double heaviest = *std::ranges::max_element(density.values);
  double total = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Mass right = byClipping(d, i, density, options.domain);
    const double slack = heaviest * (1e-12 * d.area[i] + moved * d.perimeter[i]) + 1e-18;
    EXPECT_NEAR(d.mass[i], static_cast<double>(right.mass), slack) << "site " << i;
    total += d.mass[i];
    if (right.mass <= 1e-3L * heaviest * d.area[i]) continue;
    EXPECT_NEAR(d.mass_centroid[i].x, static_cast<double>(right.x), 1e-12 + moved) << "site " << i;
    EXPECT_NEAR(d.mass_centroid[i].y, static_cast<double>(right.y), 1e-12 + moved) << "site " << i;
  }
  if (!options.outline.empty()) return;
  const double pixel = (options.domain.xmax - options.domain.xmin) / density.width *
                       ((options.domain.ymax - options.domain.ymin) / density.height);
  EXPECT_NEAR(total, std::reduce(density.values.begin(), density.values.end()) * pixel, 1e-12 * total);
}

TEST(CellMass, aDensityWithAPlaceIsNothingBeyondIt) {
  const Sites sites = generate(Pattern::random, 60, 7);
  Density small = randomDensity(4, 3, 2), padded{8, 8, std::vector<double>(64, 0)};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column)
      padded.values[(row + 3) * 8 + column + 2] = small.values[row * 4 + column];
  }
  small.box = Box{0.25, 0.25, 0.75, 0.625};
  const Diagram with_place = cellsOf(sites, under(small)), whole = cellsOf(sites, under(padded));
  EXPECT_THAT(promisesOf(check(sites, under(small), with_place)), testing::IsEmpty());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(with_place.mass[i], whole.mass[i], 1e-15);
    EXPECT_NEAR(with_place.mass_centroid[i].x, whole.mass_centroid[i].x, 1e-9);
  }
  // A place that is far smaller than the domain, or far away from it.
  small.box = Box{0.5, 0.5, 0.5 + 0x1p-40, 0.5 + 0x1p-40};
  const Diagram tiny = cellsOf(sites, under(small));
  EXPECT_NEAR(std::accumulate(tiny.mass.begin(), tiny.mass.end(), 0.0) * 0x1p80,
              std::accumulate(small.values.begin(), small.values.end(), 0.0) / 12, 1e-3);
  small.box = Box{1e12, 0, 1e12 + 1, 1};
  const Diagram none = cellsOf(sites, under(small));
  EXPECT_EQ(std::ranges::count(none.mass, 0), 60);
}

TEST(CellMass, aPlaceThatIsNoBoxAndAPeriodAreRefused) {
  Density density = randomDensity(2, 2, 1);
  density.box = Box{1, 0, 1, 1};
  const Sites sites = generate(Pattern::random, 5, 1);
  EXPECT_THAT(checkInput(sites, under(density)).error().message, testing::HasSubstr("is no box"));
  density.box = Box{0, 0, 1, 1};
  CellsOptions options = under(density);
  EXPECT_TRUE(checkInput(sites, options));
  options.periodic = Periodic::x;
  EXPECT_THAT(checkInput(sites, options).error().message, testing::HasSubstr("repeats itself"));
}

TEST(Density, massIsThatOfEachPixelsPart) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {64, 48}, {301, 200}}) {
    for (const std::uint64_t count : {1U, 20U, 500U}) {
      SCOPED_TRACE(testing::Message() << width << "x" << height << ", " << count << " sites");
      const Density density = randomDensity(width, height, 1);
      expectAsClipped(generate(Pattern::random, count, count), under(density));
      expectAsClipped(generate(Pattern::circle, count, 1), under(density), 1e-8);
    }
  }
}

TEST(Density, theDomainMayBeAnywhere) {
  Sites sites = generate(Pattern::random, 100, 3);
  const Box domain{-3, 2, 5, 4};
  for (double& x : sites.x) x = domain.xmin + 8 * x;
  for (double& y : sites.y) y = domain.ymin + 2 * y;
  expectAsClipped(sites, under(randomDensity(40, 33, 2), domain));
}

TEST(Density, cellsOfAnOutlineHaveTheMassOfTheirRings) {
  CellsOptions options = under(randomDensity(80, 60, 3));
  options.outline = country(1000);
  for (const std::uint64_t count : {1U, 30U, 400U})
    expectAsClipped(generate(Pattern::random, count, 4), options);
}

TEST(Density, periodicCellsTakeTheDensityBeyondTheDomain) {
  CellsOptions options = under(randomDensity(20, 30, 5));
  for (const Periodic periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    options.periodic = periodic;
    for (const std::uint64_t count : {1U, 3U, 200U})
      expectAsClipped(generate(Pattern::random, count, 6), options);
  }
}

TEST(Density, aConstantGivesAreasAndCentroids) {
  const Density density{640, 480, std::vector<double>(640 * 480, 1.0)};
  const Sites sites = generate(Pattern::random, 3000, 8);
  const Diagram d = cellsOf(sites, under(density));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(d.mass[i], d.area[i], 1e-12 * d.area[i]) << "site " << i;
    EXPECT_NEAR(d.mass_centroid[i].x, d.centroid[i].x, 1e-13) << "site " << i;
    EXPECT_NEAR(d.mass_centroid[i].y, d.centroid[i].y, 1e-13) << "site " << i;
  }
}

TEST(Density, cellsInsideOnePixelHaveItsDensity) {
  const Density density{2, 2, {1, 2, 3, 4}};
  const Sites sites = generate(Pattern::square, 10000, 1);
  const Diagram d = cellsOf(sites, under(density));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double value = (sites.y[i] > 0.5 ? 1 : 3) + (sites.x[i] > 0.5 ? 1 : 0);
    EXPECT_NEAR(d.mass[i], value * 1e-4, 1e-16) << "site " << i;
  }
}

TEST(Density, aRampDrawsTheCentroidToItsHeavySide) {
  // Pixel k of n has the density k + 1/2: the mass below x is n^2 x^2 / 2 at the pixels' lines.
  Density ramp{1000, 1, {}};
  for (int k = 0; k < ramp.width; ++k) ramp.values.push_back((k + 0.5) / ramp.width);
  Sites two;
  two.x = {0.25, 0.75};
  two.y = {0.5, 0.5};
  const Diagram d = cellsOf(two, under(ramp));
  EXPECT_NEAR(d.mass[0], 0.125, 1e-15);
  EXPECT_NEAR(d.mass[1], 0.375, 1e-15);
  EXPECT_NEAR(d.mass_centroid[0].x, 1.0 / 3, 1e-6);
  EXPECT_NEAR(d.mass_centroid[1].x, (1 - 1.0 / 8) / 3 / 0.375, 1e-6);
  EXPECT_NEAR(d.mass_centroid[1].y, 0.5, 1e-15);
}

TEST(Density, pixelsMayBeAsManyAsFilesHaveThem) {
  Sites two;
  two.x = {0.25, 0.75};
  two.y = {0.3, 0.7};
  for (const int count : {200'000, 300'000, 1 << 20}) {
    for (const bool tall : {false, true}) {
      SCOPED_TRACE(testing::Message() << count << (tall ? " rows" : " columns"));
      Density density{tall ? 1 : count, tall ? count : 1, std::vector<double>(std::size_t(count), 2.0)};
      density.values.back() = 0;
      const Diagram d = cellsOf(two, under(density));
      const double missing = 2.0 / count;
      EXPECT_NEAR(d.mass[0] + d.mass[1], 2 - missing, 1e-13);
      EXPECT_NEAR(d.mass[tall ? 0 : 1], 1 - (tall ? missing * 0.9 : missing), 1e-10);
    }
  }
}

TEST(Density, aHugePixelIsNothingToCellsThatItDoesNotTouch) {
  Density density{50, 50, std::vector<double>(2500, 1.0)};
  density.values[25 * 50 + 25] = 1e250;
  const Sites sites = generate(Pattern::random, 400, 9);
  const Diagram d = cellsOf(sites, under(density));
  int beside = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (d.mass[i] > 1e200) continue;
    ++beside;
    EXPECT_NEAR(d.mass[i], d.area[i], 1e-11 * d.area[i]) << "site " << i;
  }
  EXPECT_GT(beside, 390);
}

TEST(Density, withoutMassTheCentroidIsTheCells) {
  const Sites sites = mixedSites();
  CellsOptions options = under({3, 3, std::vector<double>(9, 0.0)});
  options.detail = Detail::measures;
  const Diagram d = cellsOf(sites, options);
  EXPECT_TRUE(d.vertices.empty());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(d.mass[i], 0);
    EXPECT_EQ(d.mass_centroid[i].x, d.centroid[i].x);
  }
}

/// Of strips, 1e-7 and 2e-7 high, ties make ends that are points: masses are of the strips, as areas are.
TEST(Density, cellsThinnerThanTiesHaveTheirMass) {
  for (const bool outlined : {false, true}) {
    for (const auto detail : {Detail::measures, Detail::polygons}) {
      SCOPED_TRACE(testing::Message() << outlined << ", " << static_cast<int>(detail));
      CellsOptions options = under({4, 1, {1, 3, 5, 7}});
      if (outlined) options.outline = outlineOf({{rectangle(0, 0, 1, 1)}});
      options.detail = detail;
      const Sites sites{{0, 0, 1}, {0, 2e-7, 0}, {}};
      const Diagram d = cellsOf(sites, options);
      EXPECT_NEAR(d.mass[0], 1e-7, 1e-15);
      EXPECT_NEAR(d.mass_centroid[0].x, 0.3125, 1e-8);
      EXPECT_NEAR(d.mass_centroid[0].y, 5e-8, 1e-15);
      EXPECT_NEAR(std::reduce(d.mass.begin(), d.mass.end()), 4, 1e-14);
      EXPECT_THAT(*check(sites, options, d), testing::IsEmpty());
    }
  }
  CellsOptions options = under({2, 1, {1, 3}});
  options.periodic = Periodic::x;
  const Sites sites{{0.5, 0.5, 0.5}, {0.3, 0.3 + 2e-7, 0.3 + 4e-7}, {}};
  const Diagram d = cellsOf(sites, options);
  EXPECT_NEAR(d.mass[1], 4e-7, 1e-15);
  EXPECT_NEAR(d.mass_centroid[1].x, 0.625, 1e-8);
  EXPECT_THAT(*check(sites, options, d), testing::IsEmpty());
}

TEST(Density, whatIsNoDensityIsRefused) {
  const auto refusal = [](const Density& density) {
    const auto checked = checkDensity(density);
    return checked ? "accepted" : checked.error().message;
  };
  EXPECT_EQ(refusal({2, 1, {0, 1}}), "accepted");
  EXPECT_THAT(refusal({2, 1, {0, 1, 2}}), testing::HasSubstr("3 values for 2x1"));
  EXPECT_THAT(refusal({0, 1, {1}}), testing::HasSubstr("0x1"));
  EXPECT_THAT(refusal({2, 2, {0, 1, 2, -1}}), testing::HasSubstr("row 1, column 1"));
  EXPECT_THAT(refusal({2, 1, {0, NAN}}), testing::HasSubstr("row 0, column 1"));
  const auto cells = cpuSession().cells(generate(Pattern::random, 5, 1), under({1, 1, {-2}}));
  ASSERT_FALSE(cells);
  EXPECT_EQ(cells.error().code, ErrorCode::input);
}

}  // namespace
}  // namespace vorpipe::test
