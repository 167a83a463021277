#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "unit/fixtures/cpu_session.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

/// Computes the cells on `cpu`, and says what is wrong with them.
std::string wrongWith(const Sites& sites, const Box& domain, Diagram& diagram) {
  Session session = cpuSession();
  CellsOptions options{};
  options.domain = domain;
  auto cells = session.cells(sites, options);
  if (!cells) return cells.error().message;
  diagram = std::move(*cells);
  const auto broken = check(sites, options, diagram);
  if (!broken) return broken.error().message;
  std::string all;
  for (const auto& line : *broken) all += line + "\n";
  return all;
}

std::string wrongWith(const Sites& sites, const Box& domain) {
  Diagram diagram;
  return wrongWith(sites, domain, diagram);
}

/// All sites are as near to the origin as their weights make them far: their cells nearly meet there.
Sites lifted(std::size_t count, std::uint64_t seed, double twins) {
  std::mt19937_64 random(seed);
  const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  Sites sites;
  const auto add = [&](double x, double y) {
    sites.x.push_back(x);
    sites.y.push_back(y);
    sites.weight.push_back(x * x + y * y);
  };
  while (sites.size() < count) {
    add(3 * number(), 3 * number());
    if (number() < 0.5) add(sites.x.back() + twins * number(), sites.y.back() - twins * number());
  }
  return sites;
}

TEST(CollapsedEdges, ofLiftedTwinsAreNone) {
  // The edge of the first two is longer than a tie, and all others where they meet are ties.
  const Sites sites{{2.0000000371531805, 2.0000000697305165, 2, 0},
                    {7.851393951362406e-08, 0, 2.000000968966649, 3},
                    {4.00000014861273, 4.00000027892207, 8.000003875867534, 9}};
  EXPECT_EQ(wrongWith(sites, {-0.15, -0.15, 2.15, 3.15}), "");
}

TEST(CollapsedEdges, ofManyLiftedTwinsAreNone) {
  for (const double twins : {1e-3, 1e-6, 1e-8, 1e-10}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto sites = lifted(260, seed, twins);
      EXPECT_EQ(wrongWith(sites, {-1, -1, 3, 3}), "") << twins << ", seed " << seed;
    }
  }
}

TEST(CollapsedEdges, AreThoseThatTiesOfTheDomainJoin) {
  // However small it is among the sites, their cells fill it.
  for (const double side : {1e-3, 1e-6, 1e-7, 1e-9}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto sites = lifted(30, seed, 1e-7);
      EXPECT_EQ(wrongWith(sites, {-side, -side, side, 2 * side}), "") << side << ", seed " << seed;
    }
  }
}

TEST(CollapsedEdges, LeaveSliversAtWallsTheirEdges) {
  // The cell of the third is a corner of the domain, some 1e-6 wide.
  const Sites sites{
      {0.5000004659326439, 0.7500000962477394, 2.8215781676028735e-07, 0.750000945423145, 0.5000002457615196},
      {0.75, 0.7500008815886402, 8.452871573290853e-07, 0.750000794344612, 0.5},
      {}};
  Diagram diagram;
  EXPECT_EQ(wrongWith(sites, {0.25, 0.25, 0.5, 0.75}, diagram), "");
  ASSERT_EQ(diagram.status.size(), 5u);
  EXPECT_EQ(diagram.cell_offsets[3] - diagram.cell_offsets[2], 3u);
}

}  // namespace
}  // namespace vorpipe::test
