/// Sites that own nothing get a place when sites move.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "unit/fixtures/cpu_session.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

using ::testing::ElementsAre;

RelaxOptions unitFor(std::uint64_t iterations) {
  RelaxOptions options{};
  options.domain = {0, 0, 1, 1};
  options.iterations = iterations;
  return options;
}

Relaxed relaxedOnCpu(const Sites& sites, const RelaxOptions& options) {
  Session session = cpuSession();
  auto done = relax(session, sites, options);
  EXPECT_TRUE(done) << (done ? "" : done.error().message);
  return done ? std::move(*done) : Relaxed{};
}

bool lieInUnitSquare(const Sites& sites) {
  const auto is_inside = [](double at) { return at >= 0 && at <= 1; };
  return std::ranges::all_of(sites.x, is_inside) && std::ranges::all_of(sites.y, is_inside);
}

void expectFall(const Relaxed& done) {
  double least = done.trace.front().energy;
  for (const RelaxStep& step : done.trace) {
    if (!step.taken) continue;
    EXPECT_LE(step.energy, least) << "diagram " << step.diagram;
    least = step.energy;
  }
}

TEST(LostSites, AtOnePlaceAreSetBesideEachOther) {
  const Sites sites{{0.5, 0.5, 0.5, 0.25}, {0.5, 0.5, 0.5, 0.75}, {}};
  const Relaxed done = relaxedOnCpu(sites, unitFor(5));
  EXPECT_THAT(done.report.notes, ElementsAre("2 sites at the place of another: set beside it"));
  std::set<std::pair<double, double>> places;
  for (std::size_t i = 0; i < done.sites.size(); ++i) places.emplace(done.sites.x[i], done.sites.y[i]);
  EXPECT_EQ(places.size(), sites.size());
  expectFall(done);
}

TEST(LostSites, OutsideOfTheDomainAreMovedIntoIt) {
  const Sites sites{{0.4, 0.6, 7}, {0.5, 0.5, -3}, {}};
  const Relaxed done = relaxedOnCpu(sites, unitFor(5));
  EXPECT_THAT(done.report.notes, ElementsAre("1 site outside of the domain: moved into it"));
  EXPECT_TRUE(lieInUnitSquare(done.sites));
  expectFall(done);
}

TEST(LostSites, InCellsWithoutMassAreMovedIntoThoseThatHaveMuch) {
  RelaxOptions options = unitFor(10);
  options.density = {2, 1, {0, 1}};
  const Sites sites{{0.05, 0.05, 0.6}, {0.4, 0.6, 0.5}, {}};
  const Relaxed done = relaxedOnCpu(sites, options);
  EXPECT_THAT(done.report.notes,
              ElementsAre("2 sites in cells without mass: moved into cells that have much"));
  EXPECT_TRUE(std::ranges::all_of(done.sites.x, [](double x) { return x > 0.5; }));
  expectFall(done);
}

TEST(LostSites, HiddenByHeavierOnesStay) {
  const Sites sites{{0.5, 0.5625, 0.25}, {0.5, 0.5, 0.25}, {0.125, 0, 0.125}};
  const Relaxed done = relaxedOnCpu(sites, unitFor(1));
  EXPECT_THAT(done.report.notes,
              ElementsAre("1 site without a cell, hidden by others of larger weight: left in place"));
  EXPECT_EQ(done.sites.x[1], 0.5625);
  EXPECT_EQ(done.sites.y[1], 0.5);
}

}  // namespace
}  // namespace vorpipe::test
