#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "unit/fixtures/cpu_session.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

using ::testing::HasSubstr;

CellsOptions unitSquare() {
  CellsOptions options{};
  options.domain = {0, 0, 1, 1};
  return options;
}

/// Discs that overlap here and there, and leave some of the square to the air.
Sites drops(std::size_t count, unsigned seed, Pattern pattern = Pattern::random) {
  Sites sites = generate(pattern, count, seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.2, 1.2);
  for (std::size_t i = 0; i < count; ++i) {
    sites.weight.push_back(part(random) / (std::numbers::pi * static_cast<double>(count)));
  }
  return sites;
}

TEST(FreeSurface, LatticesOfDiscsAreThoseOfTheirFormulas) {
  constexpr int side = 12;
  const double h = 1.0 / side, r = 0.6 * h, half_angle = std::acos(h / (2 * r));
  Sites sites;
  for (int k = 0; k < side * side; ++k) {
    sites.x.push_back((k % side + 0.5) * h);
    sites.y.push_back((k / side + 0.5) * h);
    sites.weight.push_back(r * r);
  }
  Session session = cpuSession();
  MovingCells moving(session, unitSquare(), Surface::free);
  ASSERT_TRUE(moving.update(sites));
  const double area =
      r * r * (std::numbers::pi - 4 * (half_angle - std::sin(half_angle) * std::cos(half_angle)));
  const double coupling = std::sqrt(r * r - h * h / 4) / h;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(moving.moments().area[i], area, 1e-14 * area);
    EXPECT_NEAR(moving.moments().centroid[i].x, sites.x[i], 1e-15);
    EXPECT_NEAR(moving.edges().arc[i], 2 * std::numbers::pi - 8 * half_angle, 1e-14);
    for (auto e = moving.neighbors().offsets[i]; e < moving.neighbors().offsets[i + 1]; ++e) {
      const auto j = moving.neighbors().neighbors[e];
      EXPECT_NEAR(moving.edges().coupling[e], isWall(j) ? 0 : coupling, 1e-14);
      if (isWall(j)) continue;
      const auto other = static_cast<std::size_t>(j);
      EXPECT_NEAR(moving.edges().middle[e].x, (sites.x[i] + sites.x[other]) / 2, 1e-15);
      EXPECT_NEAR(moving.edges().middle[e].y, (sites.y[i] + sites.y[other]) / 2, 1e-15);
    }
  }
}

TEST(FreeSurface, DiscsThatHoldTheirCellsChangeNothing) {
  Session session = cpuSession();
  Sites sites = generate(Pattern::random, 300, 2);
  sites.weight.assign(sites.size(), 3);
  MovingCells cut(session, unitSquare(), Surface::free), filling(session, unitSquare());
  ASSERT_TRUE(cut.update(sites));
  ASSERT_TRUE(filling.update(sites));
  EXPECT_EQ(cut.moments().area, filling.moments().area);
  EXPECT_EQ(cut.moments().spread, filling.moments().spread);
  ASSERT_EQ(cut.edges().coupling.size(), filling.edges().coupling.size());
  for (std::size_t e = 0; e < cut.edges().coupling.size(); ++e) {
    EXPECT_DOUBLE_EQ(cut.edges().coupling[e], filling.edges().coupling[e]);
    EXPECT_NEAR(cut.edges().middle[e].x, filling.edges().middle[e].x, 1e-15);
  }
  EXPECT_EQ(cut.edges().arc, std::vector<double>(sites.size(), 0.0));
}

/// How the areas change as one number of the sites does, by differences.
std::vector<double> slopes(MovingCells& moving, Sites sites, std::vector<double> Sites::*numbers,
                           std::size_t j) {
  constexpr double step = 1e-7;
  (sites.*numbers)[j] += step;
  EXPECT_TRUE(moving.update(sites));
  std::vector<double> slope = moving.moments().area;
  (sites.*numbers)[j] -= 2 * step;
  EXPECT_TRUE(moving.update(sites));
  for (std::size_t i = 0; i < slope.size(); ++i)
    slope[i] = (slope[i] - moving.moments().area[i]) / (2 * step);
  return slope;
}

TEST(FreeSurface, EdgesSayHowAreasChange) {
  Session session = cpuSession();
  const Sites sites = drops(60, 4);
  MovingCells moving(session, unitSquare(), Surface::free);
  ASSERT_TRUE(moving.update(sites));
  const CellsThatMeet meet = moving.neighbors();
  const EdgesOfCells edges = moving.edges();
  for (std::size_t j = 0; j < sites.size(); j += 3) {
    std::vector<double> by_weight(sites.size()), by_x(sites.size());
    by_weight[j] = edges.arc[j] / 2;
    for (auto e = meet.offsets[j]; e < meet.offsets[j + 1]; ++e) {
      if (isWall(meet.neighbors[e])) continue;
      const auto i = static_cast<std::size_t>(meet.neighbors[e]);
      by_weight[i] -= edges.coupling[e];
      by_weight[j] += edges.coupling[e];
      by_x[i] += 2 * edges.coupling[e] * (sites.x[j] - edges.middle[e].x);
    }
    const auto weight_slopes = slopes(moving, sites, &Sites::weight, j);
    const auto x_slopes = slopes(moving, sites, &Sites::x, j);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_NEAR(weight_slopes[i], by_weight[i], 1e-7) << i << " " << j;
      if (i == j) continue;
      EXPECT_NEAR(x_slopes[i], by_x[i], 1e-7) << i << " " << j;
    }
  }
}

TEST(FreeSurface, CellsAreWhatDiscsHaveOfTheSquare) {
  Session session = cpuSession();
  const Sites sites = drops(25, 9);
  MovingCells moving(session, unitSquare(), Surface::free);
  ASSERT_TRUE(moving.update(sites));
  constexpr int side = 1000;
  constexpr double pixel = 1.0 / side;
  std::vector<double> area(sites.size()), x(sites.size());
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const Point p{(column + 0.5) * pixel, (row + 0.5) * pixel};
      double least = 0;  // of the air
      std::size_t of = sites.size();
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const double dx = p.x - sites.x[i], dy = p.y - sites.y[i];
        const double power = dx * dx + dy * dy - sites.weight[i];
        if (power < least) {
          least = power;
          of = i;
        }
      }
      if (of == sites.size()) continue;
      area[of] += pixel * pixel;
      x[of] += pixel * pixel * p.x;
    }
  }
  double counted = 0, measured = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    counted += area[i];
    measured += moving.moments().area[i];
    EXPECT_NEAR(moving.moments().area[i], area[i], 2e-5) << i;
    EXPECT_NEAR(moving.moments().area[i] * moving.moments().centroid[i].x, x[i], 2e-5) << i;
  }
  EXPECT_NEAR(measured, counted, 5e-5);
}

TEST(FreeSurface, SitesWithoutWeightHaveNoCell) {
  Session session = cpuSession();
  Sites sites = drops(36, 3, Pattern::jitter);
  MovingCells moving(session, unitSquare(), Surface::free);
  EXPECT_TRUE(moving.updateUnlessEmpty(sites).value());
  sites.weight[5] = 0;
  sites.weight[6] = -1;
  sites.x[8] = sites.x[7];
  sites.y[8] = sites.y[7];
  sites.weight[8] = sites.weight[7];
  EXPECT_FALSE(moving.updateUnlessEmpty(sites).value());
  ASSERT_TRUE(moving.update(sites));
  EXPECT_EQ(moving.moments().status[5], Status::empty);
  EXPECT_EQ(moving.moments().status[6], Status::empty);
  EXPECT_EQ(moving.moments().status[8], Status::duplicate);
  EXPECT_EQ(moving.moments().area[5], 0);
  EXPECT_EQ(moving.moments().centroid[5], (Point{sites.x[5], sites.y[5]}));
  EXPECT_EQ(moving.report().empty, 2u);
  EXPECT_EQ(moving.report().ok, 33u);
  sites.weight.clear();
  ASSERT_TRUE(moving.update(sites));
  EXPECT_EQ(moving.report().ok, 0u);
}

TEST(FreeSurface, DoesNotDependOnThreads) {
  const Sites sites = drops(6000, 6);
  Session one = cpuSession(1), three = cpuSession(3);
  MovingCells a(one, unitSquare(), Surface::free), b(three, unitSquare(), Surface::free);
  ASSERT_TRUE(a.update(sites));
  ASSERT_TRUE(b.update(sites));
  EXPECT_EQ(a.moments().area, b.moments().area);
  EXPECT_EQ(a.moments().spread, b.moments().spread);
  EXPECT_EQ(a.edges().coupling, b.edges().coupling);
  EXPECT_EQ(a.edges().arc, b.edges().arc);
  // The matrix of couplings is symmetric to the bit.
  const CellsThatMeet& meet = a.neighbors();
  const auto rowOf = [&](std::size_t i) {
    return std::span(meet.neighbors).subspan(meet.offsets[i], meet.offsets[i + 1] - meet.offsets[i]);
  };
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (auto e = meet.offsets[i]; e < meet.offsets[i + 1]; ++e) {
      if (isWall(meet.neighbors[e])) continue;
      const auto j = static_cast<std::size_t>(meet.neighbors[e]);
      const auto row = rowOf(j);
      const auto back = std::ranges::find(row, static_cast<std::int64_t>(i)) - row.begin();
      ASSERT_EQ(a.edges().coupling[e], a.edges().coupling[meet.offsets[j] + static_cast<std::size_t>(back)]);
    }
  }
}

TEST(FreeSurface, RefusesWhatItDoesNotTakeYet) {
  Session session = cpuSession();
  const Sites sites = drops(10, 1);
  const auto refusedFor = [&](const CellsOptions& options) {
    const auto updated = MovingCells(session, options, Surface::free).update(sites);
    return updated ? std::string("nothing") : updated.error().message;
  };
  CellsOptions options = unitSquare();
  options.density = {1, 1, {1}};
  EXPECT_THAT(refusedFor(options), HasSubstr("a free surface takes no density yet"));
  options = unitSquare();
  options.periodic = Periodic::x;
  EXPECT_THAT(refusedFor(options), HasSubstr("a free surface takes no period yet"));
  options = unitSquare();
  options.outline = {{{0, 0}, {1, 0}, {0, 1}}, {0, 3}, {0, 1}};
  EXPECT_THAT(refusedFor(options), HasSubstr("a free surface takes no outline yet"));
}

}  // namespace
}  // namespace vorpipe::test
