/// What every backend promises of periodic domains with weights and of their pictures, by name.
#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "conformance/periodic_fixture.h"

namespace vorpipe::test {
namespace {

class WeightedPeriodicCells : public PeriodicCells {};

TEST_P(WeightedPeriodicCells, withWeightsAreTheMiddleNinthOfNineTiles) {
  for (const std::uint64_t n : {3u, 40u, 1500u}) {
    for (const double spacings : {0.5, 2.0, 100.0}) {
      SCOPED_TRACE(testing::Message() << n << " sites, weights up to " << spacings << " spacings squared");
      const auto sites = weighted(n, 5, spacings);
      for (const auto periodic : {Periodic::x, Periodic::xy}) {
        SCOPED_TRACE(testing::Message() << "periodic " << static_cast<int>(periodic));
        const auto wanted = repeated(periodic);
        const auto tiled = tile(sites, wanted);
        expectMiddle(expectRight(sites, wanted),
                     cells(tiled.sites, within(tiled.domain, {}, Detail::measures)), tiled, 1e-10);
      }
    }
  }
}

TEST_P(WeightedPeriodicCells, withEqualWeightsAreThoseWithout) {
  auto sites = generate(Pattern::random, 300, 4);
  const auto plain = expectRight(sites, repeated(Periodic::xy));
  sites.weight.assign(300, 0.75);
  const auto d = expectRight(sites, repeated(Periodic::xy));
  EXPECT_EQ(d.area, plain.area);
  EXPECT_EQ(d.neighbors, plain.neighbors);
  EXPECT_EQ(d.neighbor_shifts, plain.neighbor_shifts);
}

TEST_P(WeightedPeriodicCells, ofOneHeavySiteMayBeAll) {
  auto sites = generate(Pattern::random, 2000, 4);
  sites.weight.assign(2000, 0);
  sites.weight[7] = 10;
  const auto d = expectRight(sites, repeated(Periodic::xy));
  EXPECT_EQ(d.report.ok, 1u);
  EXPECT_EQ(d.report.empty, 1999u);
  EXPECT_NEAR(d.area[7], 1, 1e-14);
  EXPECT_EQ(imagesBeside(d, 7), (std::set<ImageOf>{{7, -1, 0}, {7, 1, 0}, {7, 0, -1}, {7, 0, 1}}));
  // Lighter ones leave something to the others, which may lie across the border from it.
  for (const double weight : {0.01, 0.2}) {
    sites.weight[7] = weight;
    EXPECT_GT(expectRight(sites, repeated(Periodic::xy)).report.ok, 100u);
  }
}

TEST_P(WeightedPeriodicCells, ofDuplicatesAcrossTheBorderBelongToTheHeaviest) {
  const Sites sites{{0, 1, 0.5, 0.5, 2.5}, {0.25, 0.25, 0.25, 0.75, 0.75}, {0.1, 0.2, 0.1, 0.2, 0.2}};
  EXPECT_EQ(expectRight(sites, repeated(Periodic::xy)).owner, (std::vector<std::uint32_t>{1, 1, 2, 3, 3}));
}

RenderOptions picture(Periodic periodic, const Box& domain = unit) {
  RenderOptions wanted{};
  wanted.domain = domain;
  wanted.periodic = periodic;
  wanted.width = 90;
  wanted.height = 70;
  return wanted;
}

class PeriodicPictures : public Cells {
 protected:
  static Rendering expectChecked(const Sites& sites, const RenderOptions& wanted) {
    auto rendering = sharedSession(GetParam()).render(sites, wanted);
    if (!rendering) throw std::runtime_error(rendering.error().message);
    const auto broken = check(sites, wanted, *rendering);
    EXPECT_EQ(broken.value_or(Lines{"no memory"}), Lines{});
    return std::move(*rendering);
  }

  /// Against nine tiles, by brute force; no site is a duplicate.
  static Rendering expectRight(const Sites& sites, const RenderOptions& wanted) {
    auto rendering = expectChecked(sites, wanted);
    CellsOptions tiles{};
    tiles.domain = wanted.domain;
    tiles.periodic = wanted.periodic;
    const auto tiled = tile(sites, tiles);
    auto image = rendering.image;
    for (auto& id : image.ids) id = nearestCopy(image, tiled, wanted.domain, id, &id - image.ids.data());
    expectNearestEverywhere(image, tiled.sites, wanted.domain);
    return rendering;
  }
};

TEST_P(PeriodicPictures, showTheNearestSiteOrImage) {
  for (const auto periodic : {Periodic::x, Periodic::y, Periodic::xy}) {
    for (const std::uint64_t n : {1u, 2u, 3u, 5u, 100u, 1000u}) {
      SCOPED_TRACE(testing::Message() << n << " sites, periodic " << static_cast<int>(periodic));
      EXPECT_EQ(expectRight(generate(Pattern::random, n, 6), picture(periodic)).report.ok, n);
    }
    expectRight(generate(Pattern::clusters, 2000, 6), picture(periodic));
    expectRight(generate(Pattern::square, 400, 6), picture(periodic, {0.1, -0.3, 1.1, 0.7}));
  }
}

TEST_P(PeriodicPictures, knowWhichSitesHaveACell) {
  const Sites sites{{0, 1, 0.5, 3.25, 0.4, 0.5}, {0.25, 0.25, 0.5, 0.75, -9, -0.2}, {}};
  const auto x = expectChecked(sites, picture(Periodic::x));
  using enum Status;
  EXPECT_EQ(x.status, (std::vector<Status>{ok, duplicate, ok, ok, empty, ok}));
  EXPECT_EQ(x.owner, (std::vector<std::uint32_t>{0, 0, 2, 3, 4, 5}));
  EXPECT_EQ(x.report.ok, 4u);
  EXPECT_EQ(x.report.empty, 1u);
  EXPECT_EQ(x.report.duplicate, 1u);
}

TEST_P(PeriodicPictures, showTheHeaviestOfTheNear) {
  for (const double spacings : {0.5, 2.0, 100.0}) {
    SCOPED_TRACE(testing::Message() << "weights up to " << spacings << " spacings squared");
    for (const auto periodic : {Periodic::x, Periodic::xy}) {
      const auto sites = weighted(300, 5, spacings);
      CellsOptions wanted{};
      wanted.domain = unit;
      wanted.periodic = periodic;
      EXPECT_EQ(expectChecked(sites, picture(periodic)).status, cells(sites, wanted).status);
    }
  }
}

TEST_P(PeriodicPictures, ofOutlinesAreRefused) {
  auto wanted = picture(Periodic::x);
  wanted.outline = {{{0, 0}, {1, 0}, {0, 1}}, {0, 3}, {0, 1}};
  const auto refused = sharedSession(GetParam()).render({{0.5}, {0.5}, {}}, wanted);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::input);
}

TEST_P(PeriodicPictures, haveColorsEdgesAndDotsOfTheSites) {
  const auto sites = generate(Pattern::random, 40, 9);
  auto wanted = picture(Periodic::xy);
  for (const auto color : {ColorBy::site, ColorBy::area, ColorBy::neighbors}) {
    wanted.color = color;
    const auto image = expectRight(sites, wanted).image;
    std::map<std::uint32_t, std::uint32_t> colors;
    for (std::size_t pixel = 0; pixel < image.ids.size(); ++pixel) {
      const auto known = colors.try_emplace(image.ids[pixel], image.rgba[pixel]).first;
      EXPECT_EQ(known->second, image.rgba[pixel]) << "all images of a site have its color";
    }
    EXPECT_EQ(colors.size(), sites.size());
  }
  // A single site meets itself along edges.
  wanted.edges = wanted.show_sites = true;
  const auto plain = expectRight({{0.3}, {0.3}, {}}, picture(Periodic::xy)).image.rgba;
  const auto drawn = expectRight({{0.3}, {0.3}, {}}, wanted).image.rgba;
  EXPECT_GT(std::ranges::count_if(drawn, [&](auto color) { return color != plain.front(); }), 90 + 70);
}

INSTANTIATE_TEST_SUITE_P(Backends, WeightedPeriodicCells, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });
INSTANTIATE_TEST_SUITE_P(Backends, PeriodicPictures, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
