/// What solvers rely on: masses to 1e-12 of the mean cell, and edges that say how masses change.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "domain/density_pixels.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/cpu_session.h"
#include "unit/fixtures/long_cells.h"

namespace vorpipe::test {
namespace {

constexpr std::size_t sites_of_a_case = 60;

struct Case {
  const char* name;
  CellsOptions options;
};

Density speckled(int width, int height) {
  Density density{width, height, {}};
  for (int k = 0; k < width * height; ++k)
    density.values.push_back(0.1 + std::abs(std::sin(12.9898 * k + 4.1 * std::sin(0.37 * k))));
  return density;
}

std::vector<Case> cases() {
  const Outline outline{{{0.02, 0.03},
                         {0.97, 0.1},
                         {0.6, 0.45},
                         {0.9, 0.98},
                         {0.1, 0.9},
                         {0.31, 0.31},
                         {0.34, 0.62},
                         {0.52, 0.55}},
                        {0, 5, 8},
                        {0, 2}};
  const auto options = [](Periodic periodic, const Outline& inside, const Density& density) {
    CellsOptions wanted{};
    wanted.domain = {0, 0, 1, 1};
    wanted.periodic = periodic;
    wanted.outline = inside;
    wanted.density = density;
    return wanted;
  };
  const Density density = speckled(13, 9);
  return {{"box", options(Periodic::none, {}, {})},
          {"periodic", options(Periodic::xy, {}, {})},
          {"outline", options(Periodic::none, outline, {})},
          {"density", options(Periodic::none, {}, density)},
          {"periodic density", options(Periodic::xy, {}, density)},
          {"half periodic density", options(Periodic::y, {}, density)},
          {"outlined density", options(Periodic::none, outline, density)}};
}

/// Every site has a cell, in the outline of the cases as well.
Sites weightedSites(std::uint64_t seed) {
  Sites sites = generate(Pattern::jitter, sites_of_a_case, seed);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites.weight.push_back(1e-3 * std::sin(7.0 * static_cast<double>(i)));
  }
  return sites;
}

std::vector<double> massesOf(MovingCells& cells, const Sites& sites) {
  const auto updated = cells.update(sites);
  EXPECT_TRUE(updated) << updated.error().message;
  return cells.moments().mass;
}

/// Central differences of all masses, by a change that `move` makes of the sites.
template <class Move>
std::vector<double> differences(MovingCells& cells, const Sites& sites, const Move& move) {
  constexpr double step = 1e-6;
  Sites more = sites, less = sites;
  move(more, step);
  move(less, -step);
  auto slope = massesOf(cells, more);
  const auto below = massesOf(cells, less);
  for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (slope[i] - below[i]) / (2 * step);
  return slope;
}

/// What the edges say.
struct Slopes {
  std::vector<double> by_weight, by_x, by_y;  ///< of all masses, by what one site does
};

/// Where the neighbor of cell i across edge e stands.
Point neighborAt(const CellsThatMeet& meet, const Sites& sites, std::size_t e) {
  const auto j = static_cast<std::size_t>(meet.neighbors[e]);
  if (meet.shifts.empty()) return {sites.x[j], sites.y[j]};
  return {sites.x[j] + meet.shifts[e][0], sites.y[j] + meet.shifts[e][1]};
}

Slopes slopesBy(std::size_t site, const CellsThatMeet& meet, const EdgesOfCells& edges, const Sites& sites) {
  Slopes slopes{std::vector<double>(sites.size()), std::vector<double>(sites.size()),
                std::vector<double>(sites.size())};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (auto e = meet.offsets[i]; e < meet.offsets[i + 1]; ++e) {
      if (meet.neighbors[e] < 0) continue;
      const double c = edges.coupling[e];
      const Point b = edges.middle[e], p = neighborAt(meet, sites, e);
      if (static_cast<std::size_t>(meet.neighbors[e]) == site) {
        slopes.by_weight[i] -= c;
        slopes.by_x[i] += 2 * c * (p.x - b.x);
        slopes.by_y[i] += 2 * c * (p.y - b.y);
      }
      if (i == site) {
        slopes.by_weight[i] += c;
        slopes.by_x[i] -= 2 * c * (sites.x[i] - b.x);
        slopes.by_y[i] -= 2 * c * (sites.y[i] - b.y);
      }
    }
  }
  return slopes;
}

void expectNear(const std::vector<double>& a, const std::vector<double>& b, double slack) {
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], slack) << "cell " << i;
}

TEST(MovingCells, edgesAreTheDerivativesOfMasses) {
  Session session = cpuSession();
  const Sites sites = weightedSites(3);
  for (const auto& [name, options] : cases()) {
    SCOPED_TRACE(name);
    MovingCells cells(session, options), moved(session, options);
    massesOf(cells, sites);
    for (const std::size_t site : {0u, 8u, 27u, 41u}) {
      SCOPED_TRACE(testing::Message() << "by site " << site);
      const Slopes slopes = slopesBy(site, cells.neighbors(), cells.edges(), sites);
      const auto by_weight =
          differences(moved, sites, [=](Sites& s, double step) { s.weight[site] += step; });
      expectNear(slopes.by_weight, by_weight, 1e-7);
      expectNear(slopes.by_x, differences(moved, sites, [=](Sites& s, double step) { s.x[site] += step; }),
                 1e-7);
      expectNear(slopes.by_y, differences(moved, sites, [=](Sites& s, double step) { s.y[site] += step; }),
                 1e-7);
    }
  }
}

/// Couplings by their two cells and the shift between them; those of several edges are added up.
std::map<std::tuple<std::size_t, std::size_t, std::int32_t, std::int32_t>, double> couplingsOf(
    const CellsThatMeet& meet, const EdgesOfCells& edges) {
  std::map<std::tuple<std::size_t, std::size_t, std::int32_t, std::int32_t>, double> couplings;
  for (std::size_t i = 0; i + 1 < meet.offsets.size(); ++i) {
    for (auto e = meet.offsets[i]; e < meet.offsets[i + 1]; ++e) {
      if (meet.neighbors[e] < 0) {
        EXPECT_EQ(edges.coupling[e], 0);
        continue;
      }
      const auto shift = meet.shifts.empty() ? std::array<std::int32_t, 2>{} : meet.shifts[e];
      couplings[{i, static_cast<std::size_t>(meet.neighbors[e]), shift[0], shift[1]}] += edges.coupling[e];
    }
  }
  return couplings;
}

TEST(MovingCells, couplingsAreThoseOfTheOtherCell) {
  Session session = cpuSession();
  for (const auto& [name, options] : cases()) {
    SCOPED_TRACE(name);
    MovingCells cells(session, options);
    massesOf(cells, weightedSites(4));
    const auto couplings = couplingsOf(cells.neighbors(), cells.edges());
    for (const auto& [key, coupling] : couplings) {
      const auto [i, j, x, y] = key;
      const auto back = couplings.find({j, i, -x, -y});
      ASSERT_NE(back, couplings.end()) << i << " and " << j;
      EXPECT_NEAR(coupling, back->second, 1e-13) << i << " and " << j;
      EXPECT_GT(coupling, 0);
    }
  }
}

TEST(MovingCells, edgesAlongALineOfPixelsHaveTheMeanOfBothSides) {
  // Rows count from the top.
  const Density density{2, 2, {1, 2, 3, 5}};
  const core::DensityPixels box(density, {0, 0, 4, 2}, Periodic::none);
  const core::DensityPixels repeated(density, {0, 0, 4, 2}, Periodic::xy);
  const auto expect = [](const core::SegmentDensity& along, double mean, double center) {
    EXPECT_DOUBLE_EQ(along.mean, mean);
    EXPECT_DOUBLE_EQ(along.center, center);
  };
  expect(densityAlong(box, {2, 0.25}, {2, 0.75}), 4, 0.5);
  expect(densityAlong(box, {1, 1}, {3, 1}), 2.75, (2 * 0.25 + 3.5 * 0.75) / 5.5);
  expect(densityAlong(box, {3, 1}, {1, 1}), 2.75, 1 - (2 * 0.25 + 3.5 * 0.75) / 5.5);
  expect(densityAlong(box, {0, 0.5}, {0, 1.5}), 2, (3 * 0.25 + 1 * 0.75) / 4);
  expect(densityAlong(repeated, {4, 0.5}, {4, 1.5}), 2.75, (4 * 0.25 + 1.5 * 0.75) / 5.5);
  expect(densityAlong(repeated, {-1, -0.5}, {1, -0.5}), 1.5, (2 * 0.25 + 1 * 0.75) / 3);
  expect(densityAlong(repeated, {1, 0.5}, {1, 0.5}), 3, 0.5);
  expect(densityAlong(box, {1, 0}, {3, 2}), 2.5, (3 * 0.25 + 2 * 0.75) / 5);
}

TEST(MovingCells, aSiteWithoutMassIsAsOneWithoutACell) {
  Session session = cpuSession();
  CellsOptions options{};
  options.domain = {0, 0, 1, 1};
  options.density = {2, 1, {1, 0}};
  MovingCells cells(session, options);
  const auto some = cells.updateUnlessEmpty({{0.3, 0.6}, {0.5, 0.5}, {}});
  ASSERT_TRUE(some);
  EXPECT_TRUE(*some);
  const auto without = cells.updateUnlessEmpty({{0.3, 0.9}, {0.5, 0.5}, {}});
  ASSERT_TRUE(without);
  EXPECT_FALSE(*without);
}

/// A lattice whose sites are moved, and get weights, by some parts of its spacing.
Sites disturbed(Pattern lattice, double by, double weights) {
  constexpr std::uint64_t count = 64;
  const double spacing = 1 / std::sqrt(static_cast<double>(count));
  Sites sites = generate(lattice, count, 1);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto k = static_cast<double>(i);
    sites.x[i] += by * spacing * std::sin(78.233 * k);
    sites.y[i] += by * spacing * std::sin(12.9898 * k * k);
    if (weights > 0) sites.weight.push_back(weights * spacing * spacing * std::sin(7.0 * k));
  }
  return sites;
}

std::vector<Case> exactCases() {
  std::vector<Case> all = cases();
  std::erase_if(all, [](const Case& c) { return c.options.periodic == Periodic::y; });
  for (Case& c : all) {
    if (!c.options.outline.empty())
      c.options.outline = {{{0.04, 0.03}, {0.97, 0.11}, {0.9, 0.98}, {0.1, 0.9}}, {0, 4}, {0, 1}};
  }
  return all;
}

double worstMass(const Sites& sites, const CellsOptions& options) {
  Session session = cpuSession();
  MovingCells cells(session, options);
  const auto masses = massesOf(cells, sites);
  const auto placed = wrapped(sites, options.domain, options.periodic);
  EXPECT_TRUE(placed);
  const LongCells exact(*placed, options, 0.45);
  double worst = 0;
  long double total = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const long double right = exact.massOf(i);
    total += right;
    worst = std::max(worst, static_cast<double>(std::abs(masses[i] - right)));
  }
  const double sum = std::reduce(masses.begin(), masses.end());
  EXPECT_NEAR(sum, static_cast<double>(total), 1e-13 * sum);
  return worst / (sum / static_cast<double>(sites.size()));
}

/// All corners of a lattice are ties, or nearly so.
TEST(MovingCells, massesOfDisturbedLatticesAreExact) {
  constexpr std::pair<double, double> disturbances[] = {{0, 0},    {1e-8, 0},    {1e-6, 0},   {1e-3, 0},
                                                        {0, 1e-8}, {1e-6, 1e-6}, {1e-3, 1e-3}};
  for (const auto& [name, options] : exactCases()) {
    for (const Pattern lattice : {Pattern::square, Pattern::hex}) {
      for (const auto& [by, weights] : disturbances) {
        const double worst = worstMass(disturbed(lattice, by, weights), options);
        EXPECT_LT(worst, 1e-12) << name << (lattice == Pattern::hex ? ", hexagonal" : ", square")
                                << ", moved by " << by << ", weights " << weights;
      }
    }
  }
}

}  // namespace
}  // namespace vorpipe::test
