/// The cells of the judge where sites have weights, against brute force in rational numbers.
#include "backend/cpu/near_cells.h"
#include "sites/site_set.h"
#include "unit/backend/cpu/judge_cases.h"

namespace vorpipe::cpu {

using namespace core;

namespace {

struct WeightedJudge : Judge {
  SiteSet noise(std::size_t count) {
    return setOf(points(count, [&] { return inBox(0, 0, 1); }));
  }

  /// Up to `most`, in mean spacings squared.
  void giveWeights(SiteSet& set, double most, double offset = 0) {
    set.weight.clear();
    for (std::size_t i = 0; i < set.size(); ++i) {
      set.weight.push_back(offset + most * uniform(random) / static_cast<double>(set.size()));
    }
  }

  static void makeHeavy(SiteSet& set, std::uint32_t site, double weight) {
    set.weight[site] = weight;
    set.heavy.push_back(site);
  }
};

TEST_F(WeightedJudge, whiteNoise) {
  for (const double most : {0.1, 1.0, 10.0, 100.0, 1e4}) {
    for (const auto count : std::initializer_list<std::size_t>{1, 2, 3, 7, 40, 120}) {
      SCOPED_TRACE(most);
      auto set = noise(count);
      giveWeights(set, most);
      compareBoth(set, 0);
    }
  }
}

TEST_F(WeightedJudge, sitesOutsideTheDomain) {
  for (const double size : {1.5, 3.0}) {
    auto set = setOf(points(150, [&] { return inBox(0.5 - size / 2, 0.5 - size / 2, size); }));
    giveWeights(set, 20);
    compareBoth(set, 0);
  }
  auto far = setOf(points(50, [&] { return inBox(4, 4, 3); }));
  giveWeights(far, 200);
  compareBoth(far, 0);
}

TEST_F(WeightedJudge, oneSiteThatSwallowsAll) {
  for (const double weight : {2.5, 1e3, 1e12, 1e170}) {
    auto set = noise(60);
    giveWeights(set, 1);
    auto listed = set;
    set.weight[17] = weight;
    makeHeavy(listed, 17, weight);
    for (const auto& some : {set, listed}) {
      compareBoth(some, 0);
      const auto found = find(findInDouble, some);
      EXPECT_EQ(std::count(found.status.begin(), found.status.end(), CellStatus::empty), 59);
    }
  }
}

TEST_F(WeightedJudge, heavySites) {
  auto set = noise(120);
  giveWeights(set, 2);
  for (std::uint32_t k = 0; k < most_heavy; ++k) makeHeavy(set, 3 * k, 0.1 * uniform(random));
  compareBoth(set, 0);
  auto all = noise(20);
  all.weight.resize(20);
  for (std::uint32_t k = 0; k < 20; ++k) makeHeavy(all, k, uniform(random));
  compareBoth(all, 0);
}

TEST_F(WeightedJudge, equalWeightsAreNone) {
  const auto set = noise(3000);
  auto weighted = set;
  for (const double weight : {0.0, -1e9, 1.0 / 3}) {
    weighted.weight.assign(set.size(), weight);
    const auto found = find(findInDouble, set);
    const auto same = find(findInDouble, weighted);
    EXPECT_EQ(found.status, same.status);
    EXPECT_EQ(found.offsets, same.offsets);
    EXPECT_EQ(found.neighbor, same.neighbor);
  }
}

TEST_F(WeightedJudge, largeOffsets) {
  for (const double offset : {1e6, -1e9}) {
    auto set = noise(100);
    giveWeights(set, 10, offset);
    compareBoth(set, 0);
  }
}

TEST_F(WeightedJudge, lattices) {
  constexpr double spacing = 0.125;
  auto set = setOf([&] {
    std::vector<Point> sites;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) sites.push_back({(i + 0.5) * spacing, (j + 0.5) * spacing});
    }
    return sites;
  }());
  // The lighter half of a checkerboard has no area left when it is lighter by the spacing squared, but for
  // the two in corners of the domain.
  constexpr double hidden = spacing * spacing;
  for (const double weight : {hidden / 2, hidden * (1 - 0x1p-20), hidden * (1 - 0x1p-50), hidden,
                              hidden * (1 + 0x1p-52), hidden * 2}) {
    SCOPED_TRACE(weight / hidden);
    set.weight.clear();
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) set.weight.push_back((i + j) % 2 == 0 ? weight : 0);
    }
    compareBoth(set, set.size());
    const auto found = find(findExactly, set);
    EXPECT_EQ(std::count(found.status.begin(), found.status.end(), CellStatus::empty),
              weight < hidden ? 0 : (weight < 2 * hidden ? 30 : 32));
  }
  for (auto& weight : set.weight) weight = hidden * std::floor(3 * uniform(random)) / 2;
  compareBoth(set, set.size());
}

/// All bisectors pass through one point.
TEST_F(WeightedJudge, oneVertexForAll) {
  auto set = setOf(points(60, [&] {
    return Point{std::round(1024 * uniform(random)) / 1024, std::round(1024 * uniform(random)) / 1024};
  }));
  const auto power = [](double x, double y) { return (x - 0.5) * (x - 0.5) + (y - 0.25) * (y - 0.25); };
  for (std::size_t i = 0; i < set.size(); ++i) set.weight.push_back(power(set.x[i], set.y[i]));
  compareBoth(set, set.size());
  for (auto& weight : set.weight) weight = std::nextafter(weight, uniform(random) < 0.5 ? 0.0 : 2.0);
  compareBoth(set, set.size());
}

TEST_F(WeightedJudge, crowdsAndCurves) {
  auto sites = points(40, [&] { return inBox(0, 0, 1); });
  for (const auto& p : points(40, [&] { return inBox(0.3, 0.6, 1e-4); })) sites.push_back(p);
  auto set = setOf(sites);
  for (std::size_t i = 0; i < set.size(); ++i) set.weight.push_back((i < 40 ? 1e-3 : 1e-9) * uniform(random));
  compareBoth(set, 2);
  set = setOf(points(80, [&] {
    const double t = uniform(random);
    return Point{t, 0.5 + 0.2 * std::sin(7 * t)};
  }));
  giveWeights(set, 0.05);
  compareBoth(set, 20);
}

TEST_F(WeightedJudge, sitesAtTheLimitOfDoubles) {
  std::vector<Point> sites{{0.3, 0.7}, {0.31, 0.2}, {0.9, 0.55}};
  double x = 0.5;
  for (int i = 0; i < 5; ++i) {
    double y = 0.5;
    for (int j = 0; j < 5; ++j) {
      sites.push_back({x, y});
      y = std::nextafter(y, 1.0);
    }
    x = std::nextafter(x, 1.0);
  }
  auto set = setOf(sites);
  for (const double scale : {1e-32, 1e-31, 1e-16}) {
    set.weight.clear();
    for (std::size_t i = 0; i < set.size(); ++i) set.weight.push_back(scale * uniform(random));
    compareBoth(set, set.size());
  }
}

/// Sites beyond what a part of a set knows may be heavier than all that it has.
TEST_F(WeightedJudge, saysWhenSitesAreMissingAround) {
  auto whole = setOf(points(4000, [&] { return inBox(-1, -1, 3); }));
  whole.domain = {-1, -1, 2, 2};
  giveWeights(whole, 1);
  SiteSet part;
  part.domain = whole.domain;
  part.coverage = {0, 0, 1, 1};
  const auto isIn = [&](std::size_t i) {
    return whole.x[i] > 0 && whole.x[i] < 1 && whole.y[i] > 0 && whole.y[i] < 1;
  };
  for (std::uint32_t i = 0; i < whole.size(); ++i) {
    if (!isIn(i)) whole.weight[i] *= 100;
    if (!isIn(i)) continue;
    part.x.push_back(whole.x[i]);
    part.y.push_back(whole.y[i]);
    part.weight.push_back(whole.weight[i]);
    part.id.push_back(i);
  }
  part.grid.heaviest = {*std::max_element(whole.weight.begin(), whole.weight.end())};
  const auto of_whole = find(findInDouble, whole);
  const auto of_part = find(findInDouble, part);
  std::size_t certified = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (of_part.status[i] != CellStatus::certified) continue;
    ++certified;
    std::set<std::uint32_t> some;
    std::set<std::uint32_t> all;
    for (auto k = of_part.offsets[i]; k < of_part.offsets[i + 1]; ++k) {
      some.insert(part.id[static_cast<std::size_t>(of_part.neighbor[k])]);
    }
    for (auto k = of_whole.offsets[part.id[i]]; k < of_whole.offsets[part.id[i] + 1]; ++k) {
      all.insert(static_cast<std::uint32_t>(of_whole.neighbor[k]));
    }
    EXPECT_EQ(some, all) << "site " << i;
  }
  EXPECT_GT(certified, 20U);
  EXPECT_GT(std::count(of_part.status.begin(), of_part.status.end(), CellStatus::unsecured), 20);
}

/// Found among the sites around, a cell is as over the tree.
TEST_F(WeightedJudge, cellsFoundNearby) {
  constexpr std::size_t count = 20000;
  auto sites = generate(Pattern::random, count, 12);
  for (std::size_t i = 0; i < count; ++i) {
    sites.weight.push_back((i < 3 ? 1e-2 : 4.0 / count) * uniform(random));
  }
  const auto set = prepare(sites, {0, 0, 1, 1}, 2)->set;
  std::vector<std::uint32_t> some;
  for (std::uint32_t i = 0; i < count; i += 97) some.push_back(i);
  some.insert(some.end(), set.heavy.begin(), set.heavy.end());
  CellNeighbors over_tree;
  CellNeighbors nearby;
  findInDouble(set, SiteTree(set, 2), some, 2, over_tree);
  findNearby(set, some, findInDouble, 2, nearby);
  std::size_t unsecured = 0;
  for (std::size_t e = 0; e < some.size(); ++e) {
    if (nearby.status[e] == CellStatus::unsecured) {
      ++unsecured;
      continue;
    }
    EXPECT_EQ(nearby.status[e], over_tree.status[e]);
    const auto rowOf = [e](const CellNeighbors& found) {
      return std::set<std::int32_t>(
          found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.offsets[e]),
          found.neighbor.begin() + static_cast<std::ptrdiff_t>(found.offsets[e + 1]));
    };
    if (nearby.status[e] == CellStatus::certified) {
      EXPECT_EQ(rowOf(nearby), rowOf(over_tree));
    }
  }
  EXPECT_LT(unsecured, some.size() / 10);
}

}  // namespace
}  // namespace vorpipe::cpu
