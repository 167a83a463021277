#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "vorpipe.h"

namespace vorpipe {
namespace {

constexpr Box3 unit{0, 0, 0, 1, 1, 1};
constexpr double infinite = std::numeric_limits<double>::infinity();

std::string refusal(const Sites3& sites, const Box3& domain) {
  const auto checked = checkInput(sites, Cells3Options{domain, Detail3::measures, {}});
  if (checked) return "";
  EXPECT_EQ(checked.error().code, ErrorCode::input);
  return checked.error().message;
}

TEST(InputInSpace, RefusesWhatNoRunCanUse) {
  const Sites3 one = {{0.5, 0.5, 0.5}};
  EXPECT_EQ(refusal(one, unit), "");
  EXPECT_EQ(refusal({}, unit), "there are no sites");
  EXPECT_EQ(refusal({{0.5, 0.5, 0.5}, {0, infinite, 0}}, unit), "site 1 is not finite: 0, inf, 0");
  EXPECT_EQ(refusal({{0.5, 0.5, std::nan("")}}, unit), "site 0 is not finite: 0.5, 0.5, nan");
  EXPECT_EQ(refusal({{1e60, 0, 0}}, unit), "site 0 is too far from the domain: 1e+60, 0, 0");
  EXPECT_EQ(refusal({{1e50, 0, 0}}, unit), "");
  const std::string no_box = "is not a box with xmin < xmax, ymin < ymax and zmin < zmax";
  EXPECT_NE(refusal(one, {0, 0, 0, 1, 1, 0}).find(no_box), std::string::npos);
  EXPECT_NE(refusal(one, {0, 0, 0, infinite, 1, 1}).find(no_box), std::string::npos);
  EXPECT_NE(refusal(one, {-1e308, 0, 0, 1e308, 1, 1}).find(no_box), std::string::npos);
  EXPECT_NE(refusal(one, {0, 0, 0, 1, 1, 1e-13}).find("at least 1e-12 of the longest"), std::string::npos);
  EXPECT_EQ(refusal(one, {0, 0, 0, 1, 1, 1e-11}), "");
  EXPECT_NE(refusal({{0, 0, 0}}, {0, 0, 0, 1e-105, 1e-105, 1e-105}).find("volumes need"), std::string::npos);
  EXPECT_EQ(refusal({{0, 0, 0}}, {0, 0, 0, 1e100, 1e100, 1e100}), "");
}

TEST(InputInSpace, ReportsTheFirstSiteOnAnyNumberOfThreads) {
  Sites3 sites = generate(Pattern3::random, 100'000, 1);
  sites[77'777].z = sites[99'999].x = std::nan("");
  for (const int threads : {1, 2, 8}) {
    const auto checked = checkInput(sites, Cells3Options{unit, Detail3::measures, {}}, threads);
    EXPECT_EQ(checked.error().message.substr(0, 10), "site 77777");
  }
}

TEST(DomainInSpace, IsTheGrownBox) {
  const Box3 box = domainOf(Sites3{{0, 0, 0}, {2, 1, 0.5}});
  EXPECT_DOUBLE_EQ(box.xmin, -0.1);
  EXPECT_DOUBLE_EQ(box.xmax, 2.1);
  EXPECT_DOUBLE_EQ(box.ymax, 1.1);
  EXPECT_DOUBLE_EQ(box.zmin, -0.1);
  EXPECT_DOUBLE_EQ(box.zmax, 0.6);
  const Box3 point = domainOf(Sites3{{3, 3, 3}});
  EXPECT_EQ(point.zmax - point.zmin, 1);
  const Box3 far = domainOf(Sites3{{1e20, 0, 0}, {1e20, 1, 1}});
  EXPECT_LT(far.xmin, 1e20);
  EXPECT_GT(far.xmax, 1e20);
}

TEST(VolumeSum, LosesNothing) {
  Diagram3 diagram;
  diagram.volume = {1, 1e-17, 1e-17, -1};
  EXPECT_EQ(volumeSum(diagram), 2e-17);
}

constexpr Pattern3 all[] = {Pattern3::random, Pattern3::jitter, Pattern3::clusters, Pattern3::sphere,
                            Pattern3::cubic,  Pattern3::bcc,    Pattern3::fcc,      Pattern3::diamond,
                            Pattern3::a15,    Pattern3::hcp};

bool isWithin(const Point3& p, const Box3& box) {
  return p.x > box.xmin && p.x < box.xmax && p.y > box.ymin && p.y < box.ymax && p.z > box.zmin &&
         p.z < box.zmax;
}

TEST(PatternsInSpace, LieInTheirBoxAndDiffer) {
  const Box3 boxes[] = {
      unit, {-1, 5, 0, 1, 6, 3}, {0, 0, 0, 100, 1, 1}, {0, 0, 0, 1e6, 1, 1}, {0, 0, 0, 1, 3e5, 2e5}};
  for (const Pattern3 pattern : all) {
    for (const Box3& box : boxes) {
      for (const std::uint64_t n : {1u, 2u, 10u, 1000u}) {
        const Sites3 sites = generate(pattern, n, 3, box);
        ASSERT_FALSE(sites.empty());
        EXPECT_LE(sites.size(), 2 * n + 8);  // a cell of a crystal has up to 8
        EXPECT_TRUE(std::ranges::all_of(sites, [&](const Point3& p) { return isWithin(p, box); }));
        EXPECT_EQ(std::set<Point3>(sites.begin(), sites.end()).size(), sites.size());
        EXPECT_EQ(sites, generate(pattern, n, 3, box));
      }
    }
    EXPECT_EQ(generate(pattern, 500, 2), generate(pattern, 500, 2, unit));
  }
}

TEST(PatternsInSpace, HaveTheSitesThatTheyAreAskedFor) {
  for (const Pattern3 pattern : {Pattern3::random, Pattern3::jitter, Pattern3::clusters, Pattern3::sphere}) {
    for (const std::uint64_t n : {1u, 7u, 1234u}) EXPECT_EQ(generate(pattern, n, 1).size(), n);
    EXPECT_NE(generate(pattern, 10, 1), generate(pattern, 10, 2));
  }
  EXPECT_EQ(generate(Pattern3::cubic, 1'000, 1).size(), 1'000u);
  EXPECT_EQ(generate(Pattern3::bcc, 2'000, 1).size(), 2'000u);
  EXPECT_EQ(generate(Pattern3::fcc, 4'000, 1).size(), 4'000u);
  EXPECT_EQ(generate(Pattern3::diamond, 8'000, 1).size(), 8'000u);
  EXPECT_EQ(generate(Pattern3::a15, 8'000, 1).size(), 8'000u);
  const auto hcp = static_cast<double>(generate(Pattern3::hcp, 100'000, 1).size());
  EXPECT_NEAR(hcp, 100'000, 10'000);
  EXPECT_EQ(generate(Pattern3::fcc, 500, 1), generate(Pattern3::fcc, 500, 9));
}

/// The numbers of sites at the least distance, and the distance itself, of sites in the middle.
std::pair<std::set<std::size_t>, double> contacts(const Sites3& sites) {
  const auto squared = [](const Point3& a, const Point3& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z);
  };
  std::set<std::size_t> counts;
  double distance = 0;
  for (const Point3& p : sites) {
    if (!isWithin(p, {0.35, 0.35, 0.35, 0.65, 0.65, 0.65})) continue;
    double least = infinite;
    for (const Point3& q : sites) {
      if (p != q) least = std::min(least, squared(p, q));
    }
    counts.insert(static_cast<std::size_t>(std::ranges::count_if(
        sites, [&](const Point3& q) { return p != q && squared(p, q) < 1.001 * least; })));
    distance = std::sqrt(least);
  }
  return {counts, distance};
}

TEST(PatternsInSpace, AreTheLatticesOfTheirNames) {
  using Counts = std::set<std::size_t>;
  EXPECT_EQ(contacts(generate(Pattern3::cubic, 1'000, 1)).first, Counts{6});
  EXPECT_EQ(contacts(generate(Pattern3::bcc, 1'024, 1)).first, Counts{8});
  EXPECT_EQ(contacts(generate(Pattern3::fcc, 2'048, 1)).first, Counts{12});
  EXPECT_EQ(contacts(generate(Pattern3::diamond, 4'096, 1)).first, Counts{4});
  EXPECT_EQ(contacts(generate(Pattern3::hcp, 2'000, 1)).first, Counts{12});
  // Sites in chains touch the next two; those of the other kind have twelve neighbors, farther away.
  EXPECT_EQ(contacts(generate(Pattern3::a15, 4'096, 1)).first, (Counts{2, 12}));
  const auto [counts, spacing] = contacts(generate(Pattern3::hcp, 5'000, 1));
  EXPECT_NEAR(spacing, std::cbrt(std::sqrt(2.0) / 5'000), 0.05 * spacing);
}

TEST(PatternsInSpace, KeepCubesInABoxOfCubes) {
  const Sites3 sites = generate(Pattern3::fcc, 1'000, 1, {0, 0, 0, 2, 1, 3});
  std::set<double> x, y, z;
  for (const Point3& p : sites) {
    x.insert(p.x);
    y.insert(p.y);
    z.insert(p.z);
  }
  EXPECT_EQ(x.size(), 2 * y.size());
  EXPECT_EQ(z.size(), 3 * y.size());
}

TEST(PatternsInSpace, LieOnTheSphere) {
  for (const Point3& p : generate(Pattern3::sphere, 1'000, 5)) {
    EXPECT_NEAR(std::hypot(p.x - 0.5, p.y - 0.5, p.z - 0.5), 0.4, 1e-15);
  }
}

}  // namespace
}  // namespace vorpipe
