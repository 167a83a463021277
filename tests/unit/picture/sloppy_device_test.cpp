/// Pictures of a device whose arithmetic and vertex grid are as coarse as the standards allow.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "backend/registry/registry.h"
#include "picture/picture.h"
#include "support/devices/sloppy_device.h"
#include "support/oracles/oracle.h"
#include "support/sites/random_sites.h"

namespace vorpipe::test {

using namespace core;

namespace {

using Way = Sloppiness::Way;

constexpr double promised = 1.0 / 128;

Sites scattered(Random& random, const Box& domain, std::size_t count, bool weighted = false) {
  const double width = domain.xmax - domain.xmin, height = domain.ymax - domain.ymin;
  Sites sites;
  for (std::size_t i = 0; i < count; ++i) {
    add(sites, {domain.xmin + random.uniform() * width, domain.ymin + random.uniform() * height});
    if (weighted)
      sites.weight.push_back(0.2 * random.uniform() * width * height / static_cast<double>(count));
  }
  return sites;
}

/// Two to four crowds of sites, each `width` times as wide as the domain.
Sites crowds(Random& random, const Box& domain, double width, bool weighted = false) {
  const double side = domain.xmax - domain.xmin;
  Sites sites;
  for (std::size_t crowd = 0; crowd < 2 + random.below(3); ++crowd) {
    const Point center{domain.xmin + random.uniform() * side,
                       domain.ymin + random.uniform() * (domain.ymax - domain.ymin)};
    for (std::size_t i = 0; i < 2 + random.below(9); ++i) {
      add(sites, {center.x + width * side * (random.uniform() - 0.5),
                  center.y + width * side * (random.uniform() - 0.5)});
      if (weighted) sites.weight.push_back(0.1 * random.uniform() * width * width * side * side);
    }
  }
  return sites;
}

RenderOptions pictureOf(const Box& domain, int width, int height) {
  RenderOptions options{};
  options.domain = domain;
  options.width = width;
  options.height = height;
  return options;
}

/// Draws on a device of these options, through the whole of a run. No pixel may be wrong, and no vertex be
/// snapped farther than promised.
Report expectRight(const SloppyOptions& device_options, const Sites& sites, const RenderOptions& options) {
  const auto device = makeSloppyDevice(device_options);
  const auto exact = openExactTier(1);
  const auto rendering = renderOn({*device, *exact, 1}, sites, options);
  EXPECT_TRUE(rendering.has_value()) << rendering.error().message;
  if (!rendering) return {};
  EXPECT_LE(device->farthestBeyond(), promised);
  const auto broken = check(sites, options, *rendering, 1);
  EXPECT_TRUE(broken.has_value() && broken->empty()) << broken->front();
  if (sites.weight.empty()) expectNearestEverywhere(rendering->image, sites, options.domain);
  return rendering->report;
}

struct SloppyPicture : testing::TestWithParam<std::tuple<int, Way>> {
  SloppyOptions options{std::get<int>(GetParam()), std::get<Way>(GetParam()), 1};
  Random random{7};
};

TEST_P(SloppyPicture, OfFewSitesIsRight) {
  for (const std::size_t count : {1u, 2u, 3u, 5u, 10u, 20u, 200u}) {
    for (int round = 0; round < 4; ++round) {
      SCOPED_TRACE(testing::Message() << count << " sites, round " << round);
      options.seed = random();
      const Box domain{-0.3, 0.1, 0.9, 0.7};
      expectRight(options, scattered(random, domain, count), pictureOf(domain, 150, 75));
    }
  }
}

// Cells of up to some thousand pixels, in views of up to 4096.
TEST_P(SloppyPicture, OfLargeCellsIsRight) {
  for (const int width : {1000, 4096, 9000}) {
    for (const std::size_t count : {2u, 7u, 20u}) {
      SCOPED_TRACE(testing::Message() << count << " sites, " << width << " pixels");
      options.seed = random();
      const Box domain{0, 0, static_cast<double>(width), 24};
      const auto sites = scattered(random, domain, count);
      expectRight(options, sites, pictureOf(domain, width, 24));
    }
  }
}

TEST_P(SloppyPicture, OfSmallCellsIsRight) {
  for (const int side : {8, 40, 90}) {
    SCOPED_TRACE(side);
    const Box domain{0, 0, 1, 1};
    expectRight(options, scattered(random, domain, 1500), pictureOf(domain, side, side));
  }
}

TEST_P(SloppyPicture, OfCrowdsIsRight) {
  for (int power = 5; power <= 13; ++power) {
    for (const bool weighted : {false, true}) {
      SCOPED_TRACE(testing::Message() << "crowds 1e-" << power << " wide" << (weighted ? ", weighted" : ""));
      options.seed = random();
      const Box domain{0.25, 0.5, 0.75, 1};
      const auto sites = crowds(random, domain, std::pow(10, -power), weighted);
      expectRight(options, sites, pictureOf(domain, 120, 120));
    }
  }
}

TEST_P(SloppyPicture, OfWeightedSitesIsRight) {
  for (const std::size_t count : {3u, 20u, 300u}) {
    SCOPED_TRACE(count);
    options.seed = random();
    const Box domain{0, 0, 2, 1};
    expectRight(options, scattered(random, domain, count, true), pictureOf(domain, 160, 80));
  }
}

std::string nameOf(const testing::TestParamInfo<std::tuple<int, Way>>& tested) {
  const std::array ways{"exact", "up", "down", "random"};
  const auto [bits, way] = tested.param;
  return std::to_string(bits) + "bits_" + ways[static_cast<std::size_t>(way)];
}

INSTANTIATE_TEST_SUITE_P(Devices, SloppyPicture,
                         testing::Combine(testing::Values(4, 5, 6, 8, 12),
                                          testing::Values(Way::none, Way::up, Way::down, Way::random)),
                         nameOf);

// What docs/algorithm.md, "What floats lose", builds on.
TEST(SloppyBisectors, AreAsNearlyRightAsTheirProductsAre) {
  Random random(7);
  Sites sites;
  add(sites, {0.5, 0.5});
  for (int i = 0; i < 20000; ++i) {
    const auto part = [&] { return static_cast<double>(random.below(1U << 20)) / (1U << 20); };
    const double x = part(), y = part();
    if (x != 0.5 || y != 0.5) add(sites, {x, y});
  }
  for (const auto way : {Way::none, Way::up, Way::down, Way::random}) {
    const BisectorLoss loss = lossOfBisectors(sites, way, 1);
    EXPECT_LE(loss.length, 4);
    EXPECT_LE(loss.direction, 2);
    EXPECT_LE(loss.distance, 4);
  }
}

// With floats that are rounded exactly, no pixel and hardly a cell is found again.
TEST(SloppyPictureOf8Bits, OfManySitesNeedsNoneOfThis) {
  Random random(7);
  const Box domain{0, 0, 1, 1};
  const SloppyOptions options{8, Way::none, 1};
  const auto report = expectRight(options, scattered(random, domain, 3000), pictureOf(domain, 300, 300));
  EXPECT_EQ(report.pixels, 0u);
  EXPECT_LE(report.in_double, 5u)
      << "cells of more edges than there is room for, and where sites are crowded";
}

// Where the grid of vertices is coarse, cells are shrunk, and coverRest finds the pixels between them.
TEST(SloppyPictureOf4Bits, LeavesPixelsAtTheEdgesOfCells) {
  Random random(7);
  const Box domain{0, 0, 1, 1};
  const SloppyOptions options{4, Way::none, 1};
  const auto report = expectRight(options, scattered(random, domain, 300), pictureOf(domain, 300, 300));
  EXPECT_GT(report.pixels, 0u);
  EXPECT_LT(report.pixels, 300u * 300u / 50);
}

}  // namespace
}  // namespace vorpipe::test
