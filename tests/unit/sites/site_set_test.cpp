#include "sites/site_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "sites/grid.h"
#include "support/sites/unit.h"

namespace vorpipe::test {

using namespace core;

namespace {

/// The lowest index at each position.
std::map<std::pair<double, double>, std::uint32_t> ownersOf(const Sites& sites) {
  std::map<std::pair<double, double>, std::uint32_t> owners;
  for (std::uint32_t i = 0; i < sites.size(); ++i) owners.emplace(std::pair(sites.x[i], sites.y[i]), i);
  return owners;
}

void expectUnique(const Sites& sites, const Prepared& prepared) {
  const auto owners = ownersOf(sites);
  EXPECT_EQ(prepared.set.size(), owners.size());
  ASSERT_EQ(prepared.owner.size(), sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    ASSERT_EQ(prepared.owner[i], owners.at({sites.x[i], sites.y[i]})) << "site " << i;
  }
}

void expectInBins(const Sites& sites, const Prepared& prepared) {
  const auto& set = prepared.set;
  const auto& grid = set.grid;
  ASSERT_EQ(grid.offsets.size(), std::size_t{grid.columns} * grid.rows + 1);
  EXPECT_EQ(grid.offsets.front(), 0u);
  EXPECT_EQ(grid.offsets.back(), set.size());
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const auto bin = std::size_t{row} * grid.columns + column;
      ASSERT_LE(grid.offsets[bin], grid.offsets[bin + 1]);
      for (auto i = grid.offsets[bin]; i < grid.offsets[bin + 1]; ++i) {
        const auto id = set.id[i];
        ASSERT_EQ(set.x[i], std::ldexp(sites.x[id], prepared.exponent));
        ASSERT_EQ(set.y[i], std::ldexp(sites.y[id], prepared.exponent));
        ASSERT_EQ(binOf(grid, set.x[i], set.y[i]), bin);
        ASSERT_TRUE(i == grid.offsets[bin] || set.id[i - 1] < id);
      }
    }
  }
}

/// In the coordinates of the grid, a site within it lies in its bin, but for rounding.
void expectInsideBins(const Prepared& prepared) {
  const auto& grid = prepared.set.grid;
  const double rounding = 1e-12 * (1 + std::abs(grid.xmin) + std::abs(grid.ymin));
  for (std::size_t i = 0; i < prepared.set.size(); ++i) {
    const auto bin = binOf(grid, prepared.set.x[i], prepared.set.y[i]);
    const double x = prepared.set.x[i] - (grid.xmin + (bin % grid.columns) * grid.size);
    const double y = prepared.set.y[i] - (grid.ymin + (bin / grid.columns) * grid.size);
    ASSERT_GE(std::min(x, y), -rounding);
    ASSERT_LE(std::max(x, y), grid.size + rounding);
  }
}

Prepared expectOrdered(const Sites& sites, const Box& domain = unit) {
  auto prepared = prepare(sites, domain, 2);
  EXPECT_TRUE(prepared) << prepared.error().message;
  expectUnique(sites, *prepared);
  expectInBins(sites, *prepared);
  EXPECT_LE(std::size_t{prepared->set.grid.columns} * prepared->set.grid.rows, sites.size() + 2);
  return std::move(*prepared);
}

/// Sites on top of each other, near each other and spread, several hundred thousand in no order.
Sites unevenSites(std::size_t count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  Sites sites;
  for (std::size_t i = 0; i < count; ++i) {
    const auto kind = random() % 4;
    const double x = kind == 0 ? 0.5 + 1e-9 * uniform(random) : uniform(random);
    const double y = kind == 0 ? 0.5 + 1e-9 * uniform(random) : uniform(random);
    const auto twin = kind == 1 && i > 0 ? random() % i : i;
    sites.x.push_back(twin < i ? sites.x[twin] : x);
    sites.y.push_back(twin < i ? sites.y[twin] : y);
  }
  return sites;
}

TEST(Prepare, EverySiteIsInItsBin) {
  for (const auto pattern :
       {Pattern::random, Pattern::square, Pattern::hex, Pattern::clusters, Pattern::circle}) {
    expectInsideBins(expectOrdered(generate(pattern, 20000, 3)));
  }
}

TEST(Prepare, EvenSitesFillTheBinsEvenly) {
  const auto prepared = expectOrdered(generate(Pattern::random, 20000, 1));
  const auto& grid = prepared.set.grid;
  const double bins = static_cast<double>(grid.columns) * grid.rows;
  EXPECT_NEAR(20000 / bins, sites_per_bin, 0.1);
}

TEST(Prepare, FindsDuplicatesInCrowdedBins) { expectInsideBins(expectOrdered(unevenSites(100000))); }

TEST(Prepare, AllSitesInOnePlaceAreOne) {
  Sites sites{std::vector<double>(5000, 0.25), std::vector<double>(5000, 0.75), {}};
  EXPECT_EQ(expectOrdered(sites).set.size(), 1u);
  EXPECT_EQ(expectOrdered({{0.5}, {0.5}, {}}).set.size(), 1u);
}

TEST(Prepare, ZeroHasNoSign) {
  EXPECT_EQ(expectOrdered({{0.0, -0.0, 0.5}, {0.0, 0.0, -0.0}, {}}).set.size(), 2u);
}

TEST(Prepare, SitesOnALineHaveARowOfBins) {
  Sites level;
  Sites upright;
  for (int i = 0; i < 3000; ++i) {
    level.x.push_back(i / 3000.0);
    level.y.push_back(0.5);
  }
  upright.x = level.y;
  upright.y = level.x;
  EXPECT_EQ(expectOrdered(level).set.grid.rows, 1u);
  EXPECT_GT(expectOrdered(level).set.grid.columns, 1000u);
  EXPECT_EQ(expectOrdered(upright).set.grid.columns, 1u);
  EXPECT_GT(expectOrdered(upright).set.grid.rows, 1000u);
}

TEST(Prepare, SitesFarOutsideDoNotWidenTheBins) {
  auto sites = generate(Pattern::random, 10000, 1);
  const auto size = expectOrdered(sites).set.grid.size;
  for (const double far : {0x1p299, -0x1p299, 1e6, -50.0}) {
    sites.x.push_back(far);
    sites.y.push_back(0.25);
    sites.x.push_back(0.75);
    sites.y.push_back(far);
  }
  const auto prepared = expectOrdered(sites);
  EXPECT_LT(prepared.set.grid.size, 3.1 * size);
  EXPECT_EQ(prepared.set.size(), sites.size());
}

TEST(Prepare, GridOfSitesFarOutsideEndsOutsideTheDomain) {
  const auto prepared = expectOrdered({{-5, 0.5, 1e9}, {-1e9, 0.5, 0.25}, {}});
  const auto& grid = prepared.set.grid;
  EXPECT_LT(grid.xmin, 0);
  EXPECT_LT(grid.ymin, 0);
  EXPECT_GT(grid.xmin + grid.columns * grid.size, 1);
}

TEST(Prepare, WorksInAnyUnits) {
  for (const int exponent : {-1000, -30, 40, 900}) {
    auto sites = generate(Pattern::random, 500, 1);
    for (auto& x : sites.x) x = std::ldexp(x, exponent);
    for (auto& y : sites.y) y = std::ldexp(y, exponent);
    const double side = std::ldexp(1.0, exponent);
    const auto prepared = expectOrdered(sites, {0, 0, side, side});
    EXPECT_EQ(prepared.exponent, -exponent);
    EXPECT_EQ(prepared.set.domain.xmax, 1);
  }
}

TEST(Prepare, DoesNotDependOnThreads) {
  const auto sites = unevenSites(300000);
  const auto one = prepare(sites, unit, 1);
  const auto many = prepare(sites, unit, 7);
  ASSERT_TRUE(one && many);
  EXPECT_EQ(one->set.x, many->set.x);
  EXPECT_EQ(one->set.y, many->set.y);
  EXPECT_EQ(one->set.id, many->set.id);
  EXPECT_EQ(one->set.grid.offsets, many->set.grid.offsets);
  EXPECT_EQ(one->owner, many->owner);
}

TEST(Prepare, RefusesSitesThatAreTooNear) {
  const auto isRefused = [](double x, double y, double other_x, double other_y) {
    const auto prepared = prepare({{0.5, x, 0.75, other_x}, {0.5, y, 0.5, other_y}, {}}, unit, 2);
    return !prepared && prepared.error().message.starts_with("sites 1 and 3: ");
  };
  for (const double apart : {1e-300, 1e-100, 1e-50, 1e-30, 3e-25}) {
    EXPECT_TRUE(isRefused(0, 0.9, apart, 0.9)) << apart;
    EXPECT_TRUE(isRefused(0.9, apart, 0.9, 0)) << apart;
    EXPECT_TRUE(isRefused(0.9, apart / 2, 0.9, -apart / 2)) << apart;
    EXPECT_TRUE(isRefused(apart, 0, 0, apart)) << apart;
  }
  for (const double apart : {0.0, 1.7e-24, 1e-20, 1e-12}) {
    EXPECT_FALSE(isRefused(0, 0.9, apart, 0.9)) << apart;
    EXPECT_FALSE(isRefused(apart, 0, 0, apart)) << apart;
    EXPECT_FALSE(isRefused(1e-30, 0.2, 2e-30, 0.3 + apart)) << apart;
  }
}

TEST(Prepare, FindsSitesThatAreTooNearAmongManyInARow) {
  Sites sites;
  for (int i = 0; i < 3000; ++i) {
    sites.x.push_back(i % 100 / 100.0);
    sites.y.push_back(1e-20 * (i / 100));
  }
  EXPECT_TRUE(prepare(sites, unit, 2));
  sites.x.push_back(sites.x[250]);
  sites.y.push_back(sites.y[250] * (1 + 1e-8));
  const auto prepared = prepare(sites, unit, 2);
  ASSERT_FALSE(prepared);
  EXPECT_TRUE(prepared.error().message.starts_with("sites 250 and 3000: ")) << prepared.error().message;
}

TEST(Prepare, RefusesWhatIsNoSite) {
  const auto refused = [](double x, double y) {
    const auto prepared = prepare({{0.5, x}, {0.5, y}, {}}, unit, 1);
    return prepared ? std::string() : prepared.error().message;
  };
  EXPECT_EQ(refused(0.5, std::numeric_limits<double>::quiet_NaN()), "site 1 is not finite: 0.5, nan");
  EXPECT_EQ(refused(std::numeric_limits<double>::infinity(), 0), "site 1 is not finite: inf, 0");
  EXPECT_NE(refused(0, 1e300).find("site 1 is too far from the domain"), std::string::npos);
  EXPECT_FALSE(prepare({}, unit, 1));
  EXPECT_FALSE(prepare({{0, 1}, {0}, {}}, unit, 1));
  EXPECT_FALSE(prepare({{0}, {0}, {}}, {0, 0, 0, 1}, 1));
}

}  // namespace
}  // namespace vorpipe::test
