#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "motion/start_weights.h"
#include "unit/fixtures/cpu_session.h"
#include "unit/motion/blob.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TransportOptions transportOptions(double tolerance = 1e-12) {
  TransportOptions options{};
  options.domain = {0, 0, 1, 1};
  options.tolerance = tolerance;
  return options;
}

Transported transported(const Sites& sites, const TransportOptions& options, int threads = 0) {
  Session session = cpuSession(threads);
  auto done = transport(session, sites, options);
  EXPECT_TRUE(done) << (done ? "" : done.error().message);
  return done ? std::move(*done) : Transported{};
}

Error refused(const Sites& sites, const TransportOptions& options) {
  Session session = cpuSession();
  const auto done = transport(session, sites, options);
  EXPECT_FALSE(done);
  return done ? Error{} : done.error();
}

double worstOf(const std::vector<double>& mass, const std::vector<double>& target) {
  double worst = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    worst = std::max(worst, std::abs(mass[i] - target[i]) / target[i]);
  }
  return worst;
}

std::vector<double> equalShares(std::size_t count) {
  return std::vector<double>(count, 1.0 / static_cast<double>(count));
}

/// The masses 1 to `most`, as the sites come, of the unit square.
std::vector<double> unequal(std::size_t count, std::size_t most) {
  std::vector<double> masses(count);
  for (std::size_t i = 0; i < count; ++i) masses[i] = static_cast<double>(1 + i * 7919 % most);
  const double sum = std::accumulate(masses.begin(), masses.end(), 0.0);
  for (double& mass : masses) mass /= sum;
  return masses;
}

Sites lattice(int side, double x_scale, double y_scale) {
  Sites sites;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      sites.x.push_back(x_scale * (column + 0.5) / side);
      sites.y.push_back(y_scale * (row + 0.5) / side);
    }
  }
  return sites;
}

TEST(Transport, randomSitesGetEqualAreasInFewDiagrams) {
  const Sites sites = generate(Pattern::random, 10000, 1);
  const Transported done = transported(sites, transportOptions());
  EXPECT_EQ(done.end, TransportEnd::converged);
  EXPECT_LE(done.trace.size(), 12u);
  EXPECT_LE(worstOf(done.cells.mass, equalShares(sites.size())), 1e-12);
  EXPECT_EQ(done.sites.x, sites.x);
}

TEST(Transport, theCellsOfItsWeightsAreItsCells) {
  const Transported done = transported(generate(Pattern::random, 3000, 2), transportOptions());
  Session session = cpuSession();
  CellsOptions options{};
  options.domain = {0, 0, 1, 1};
  const Diagram diagram = session.cells(done.sites, options).value();
  EXPECT_LE(worstOf(diagram.area, equalShares(diagram.size())), 2e-12);
}

/// The map from the unit square to the lattice halves it, so that weights are those of its convex function.
TEST(Transport, aLatticeOfHalfTheSizeHasTheWeightsOfAScaling) {
  constexpr int side = 24;
  const Sites sites = lattice(side, 0.5, 0.5);
  const Transported done = transported(sites, transportOptions(1e-13));
  for (std::size_t i = 1; i < sites.size(); ++i) {
    const auto expected = [&](std::size_t k) { return -(sites.x[k] * sites.x[k] + sites.y[k] * sites.y[k]); };
    EXPECT_NEAR(done.sites.weight[i] - done.sites.weight[0], expected(i) - expected(0), 1e-12);
  }
  const double spacing = 1.0 / side;
  EXPECT_NEAR(done.cost, 1.0 / 6 + spacing * spacing / 8, 1e-12);
}

TEST(Transport, affineMapsHaveTheirClosedForm) {
  const Sites sites = lattice(20, 0.5, 0.8);
  const Transported done = transported(sites, transportOptions(1e-13));
  const auto expected = [&](std::size_t k) {
    return sites.x[k] * sites.x[k] * (1 - 1 / 0.5) + sites.y[k] * sites.y[k] * (1 - 1 / 0.8);
  };
  for (std::size_t i = 1; i < sites.size(); ++i) {
    EXPECT_NEAR(done.sites.weight[i] - done.sites.weight[0], expected(i) - expected(0), 1e-12);
  }
}

TEST(Transport, aHexagonalLatticeThatRepeatsIsThereAlready) {
  TransportOptions options = transportOptions();
  Sites sites;
  constexpr int columns = 16, rows = 18;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      sites.x.push_back((column + (row % 2) * 0.5) / columns);
      sites.y.push_back((row + 0.5) / rows);
    }
  }
  options.domain = {0, 0, 1, rows * std::sqrt(3.0) / 2 / columns};
  for (double& y : sites.y) y *= options.domain.ymax;
  options.periodic = Periodic::xy;
  const Transported done = transported(sites, options);
  EXPECT_EQ(done.trace.size(), 1u);
  for (const double weight : done.sites.weight) EXPECT_NEAR(weight, 0, 1e-15);
}

TEST(Transport, massesMayBeFarFromEachOther) {
  const Sites sites = generate(Pattern::random, 4000, 3);
  TransportOptions options = transportOptions(1e-8);
  options.masses = unequal(sites.size(), 10000);
  const Transported done = transported(sites, options);
  EXPECT_EQ(done.end, TransportEnd::converged);
  EXPECT_LE(worstOf(done.cells.mass, options.masses), 1e-8);
}

TEST(Transport, clustersAndSitesOutsideGetTheirShares) {
  for (Sites sites : {generate(Pattern::clusters, 3000, 4), generate(Pattern::random, 3000, 5)}) {
    const bool clusters = sites.x == generate(Pattern::clusters, 3000, 4).x;
    for (double& x : sites.x) x = clusters ? x : 0.9 + 0.3 * x;
    for (double& y : sites.y) y = clusters ? y : -0.5 + 0.3 * y;
    const Transported done = transported(sites, transportOptions(1e-9));
    EXPECT_EQ(done.end, TransportEnd::converged);
    EXPECT_LE(worstOf(done.cells.mass, equalShares(sites.size())), 1e-9);
  }
}

TEST(Transport, densitiesEndQuadratically) {
  const Sites sites = generate(Pattern::random, 1000, 6);
  TransportOptions options = transportOptions(1e-10);
  options.density = blob(64, 0.01);
  const Transported done = transported(sites, options);
  EXPECT_EQ(done.end, TransportEnd::converged);
  std::vector<double> worst;
  for (const TransportStep& step : done.trace) {
    if (step.taken) worst.push_back(step.worst);
  }
  ASSERT_GE(worst.size(), 3u);
  // Before rounding: the digits double.
  const double before = worst[worst.size() - 3], then = worst[worst.size() - 2];
  EXPECT_LT(then, 10 * before * before + 1e-10);
}

/// A chessboard whose black squares have a thousandth of what the white ones have.
TEST(Transport, densitiesMayBeFarFromEven) {
  const Sites sites = generate(Pattern::random, 1000, 1);
  TransportOptions options = transportOptions(1e-8);
  options.density = {5, 5, {}};
  for (int k = 0; k < 25; ++k) options.density.values.push_back(k % 2 == 0 ? 1 : 1e-3);
  const Transported done = transported(sites, options);
  EXPECT_EQ(done.end, TransportEnd::converged);
  const auto [least, most] = std::ranges::minmax(done.cells.mass);
  EXPECT_NEAR(least / most, 1, 1e-7);
  // What ends on its way through softer densities has cells of the density all the same.
  options.diagrams = done.trace.size() - 20;
  const Transported ended = transported(sites, options);
  EXPECT_EQ(ended.end, TransportEnd::diagrams);
  EXPECT_LE(ended.trace.size(), options.diagrams);
  const auto last =
      std::find_if(ended.trace.rbegin(), ended.trace.rend(), [](auto& step) { return step.taken; });
  ASSERT_NE(last, ended.trace.rend());
  EXPECT_NEAR(last->least,
              std::ranges::min(ended.cells.mass) * 1000 /
                  std::reduce(ended.cells.mass.begin(), ended.cells.mass.end()),
              1e-9);
}

TEST(Transport, sitesMayLieWhereThereIsNoMass) {
  Sites sites = generate(Pattern::random, 300, 10);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites.x[i] = 0.6 + 0.4 * sites.x[i];
    sites.y[i] = 0.6 + 0.4 * sites.y[i];
  }
  TransportOptions letter = transportOptions(1e-8), half = transportOptions(1e-8);
  letter.outline = {{{0, 0}, {1, 0}, {1, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}}, {0, 6}, {0, 1}};
  half.density = {2, 1, {1, 0}};
  for (const TransportOptions& options : {letter, half}) {
    const Transported done = transported(sites, options);
    EXPECT_EQ(done.end, TransportEnd::converged);
    const auto [least, most] = std::ranges::minmax(done.cells.mass);
    EXPECT_NEAR(least / most, 1, 1e-7);
  }
}

TEST(Transport, islandsShareTheirSites) {
  TransportOptions options = transportOptions(1e-8);
  options.outline = {
      {{0, 0}, {0.3, 0}, {0.3, 1}, {0, 1}, {0.6, 0.1}, {1, 0.1}, {1, 0.7}, {0.6, 0.7}}, {0, 4, 8}, {0, 1, 2}};
  const Transported done = transported(generate(Pattern::random, 200, 11), options);
  EXPECT_EQ(done.end, TransportEnd::converged);
  const auto [least, most] = std::ranges::minmax(done.cells.mass);
  EXPECT_NEAR(least / most, 1, 1e-7);
}

TEST(Transport, weightsThatAreRightAreLeft) {
  const Transported first = transported(generate(Pattern::random, 2000, 7), transportOptions(1e-9));
  const Transported second = transported(first.sites, transportOptions(1e-8));
  EXPECT_EQ(second.trace.size(), 1u);
}

TEST(Transport, threadsDoNotMatter) {
  const Sites sites = generate(Pattern::clusters, 2500, 8);
  const Transported one = transported(sites, transportOptions(1e-8), 1);
  const Transported three = transported(sites, transportOptions(1e-8), 3);
  EXPECT_EQ(one.sites.weight, three.sites.weight);
  EXPECT_EQ(one.cells.mass, three.cells.mass);
}

TEST(Transport, whatTheWatcherStopsIsReturned) {
  Session session = cpuSession();
  const auto done = transport(session, generate(Pattern::random, 500, 9), transportOptions(),
                              [](const TransportStep& step) { return step.diagram < 2; });
  ASSERT_TRUE(done);
  EXPECT_EQ(done->end, TransportEnd::cancelled);
  EXPECT_EQ(done->sites.weight.size(), 500u);
}

TEST(Transport, massesThatCannotBeAreRefused) {
  const Sites sites = generate(Pattern::random, 4, 1);
  TransportOptions options = transportOptions();
  const auto refusedWith = [&](std::vector<double> masses, auto text) {
    options.masses = std::move(masses);
    const Error error = refused(sites, options);
    EXPECT_EQ(error.code, ErrorCode::input);
    EXPECT_EQ(error.subject, Subject::masses);
    EXPECT_THAT(error.message, text);
  };
  refusedWith({0.5, 0.5}, HasSubstr("2 for 4 sites"));
  refusedWith({0.5, -0.5, 0.5, 0.5}, HasSubstr("site 1 (counted from 0) is -0.5"));
  refusedWith({0.5, 0.5, std::nan(""), 0.5}, HasSubstr("site 2"));
  refusedWith({0.5, 0.5, 0.5, 0.5}, AllOf(HasSubstr("add up to 2"), HasSubstr("to 1")));
}

/// Distinct sites have weights, wherever they are; along the axis that repeats they stay where they are.
TEST(Transport, sitesBeyondAWallOfTheAxisThatDoesNotRepeatGetTheirShares) {
  TransportOptions options = transportOptions(1e-9);
  options.domain = {0, 0, 3, 0.5};
  options.periodic = Periodic::x;
  for (const Sites& sites : {Sites{{0.5, 0.5, 0.52}, {0.2, 0.7, 0.9}, {}},
                             Sites{{0.1, 1.2, 2.9, 2.9}, {-3, -3.5, 0.2, 0.21}, {}}}) {
    const Transported done = transported(sites, options);
    EXPECT_EQ(done.end, TransportEnd::converged);
    EXPECT_EQ(done.sites.x, sites.x);
    const double share = 1.5 / static_cast<double>(sites.size());
    EXPECT_LE(worstOf(done.cells.mass, std::vector<double>(sites.size(), share)), 1e-9);
  }
  options.domain = {0, 0, 0.5, 3};
  options.periodic = Periodic::y;
  const Transported turned = transported({{0.2, 0.7, 0.9}, {0.5, 0.5, 0.52}, {}}, options);
  EXPECT_EQ(turned.end, TransportEnd::converged);
}

TEST(Transport, sitesAtOnePlaceAreRefused) {
  Sites sites = generate(Pattern::random, 10, 1);
  sites.x[7] = sites.x[3];
  sites.y[7] = sites.y[3];
  EXPECT_THAT(refused(sites, transportOptions()).message, HasSubstr("sites 3 and 7"));
}

TEST(Transport, bothEndsOfAPeriodAreOnePlace) {
  TransportOptions options = transportOptions();
  options.periodic = Periodic::xy;
  EXPECT_THAT(refused({{0, 0.5, 1}, {0.25, 0.5, 0.25}, {}}, options).message, HasSubstr("sites 0 and 2"));
  options.periodic = Periodic::y;
  EXPECT_TRUE(transported({{0, 0.5, 1}, {0.25, 0.5, 0.25}, {}}, options).sites.size() == 3);
}

TEST(Transport, noMoreDiagramsAreMadeThanAreAllowed) {
  TransportOptions options = transportOptions();
  const Sites sites = generate(Pattern::clusters, 300, 1);
  for (const std::uint64_t most : {1u, 2u, 5u, 9u}) {
    options.diagrams = most;
    const Transported done = transported(sites, options);
    EXPECT_EQ(done.end, TransportEnd::diagrams);
    // The last that was kept is measured again where the last of all was not.
    EXPECT_LE(done.trace.size(), most + 1);
  }
}

/// Weights of the lightest cells are far less than others, whose rounding they must not have.
TEST(Transport, massesOfAllMagnitudesAreThoseOfTheWeightsThatAreReturned) {
  const Sites sites = generate(Pattern::random, 30, 5);
  TransportOptions options = transportOptions(1e-7);
  for (std::size_t i = 0; i < sites.size(); ++i)
    options.masses.push_back(std::pow(10.0, -8.0 * static_cast<double>(i) / 29));
  const double sum = std::accumulate(options.masses.begin(), options.masses.end(), 0.0);
  for (double& mass : options.masses) mass /= sum;
  const Transported done = transported(sites, options);
  ASSERT_EQ(done.end, TransportEnd::converged);
  Session session = cpuSession();
  CellsOptions cells{};
  cells.domain = {0, 0, 1, 1};
  EXPECT_LE(worstOf(session.cells(done.sites, cells).value().area, options.masses), 1e-7);
}

TEST(Transport, whatADoubleCannotWeighIsRefused) {
  const Sites sites = generate(Pattern::random, 4, 1);
  TransportOptions options = transportOptions();
  options.domain = {0, 0, 1e80, 1e80};
  EXPECT_THAT(refused(sites, options).message, HasSubstr("1e+80 wide"));
  EXPECT_EQ(refused(sites, options).subject, Subject::domain);
  options = transportOptions(std::nan(""));
  EXPECT_THAT(refused(sites, options).message, HasSubstr("tolerance: nan"));
  options = transportOptions();
  options.density = {1, 1, {1e100}};
  EXPECT_THAT(refused(sites, options).message, HasSubstr("density: its largest value is 1e+100"));
}

}  // namespace
}  // namespace vorpipe::test
