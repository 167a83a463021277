/// What every backend promises, by name: the same suite for each.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "picture_of.h"
#include "support/devices/backends.h"
#include "support/oracles/oracle.h"
#include "support/shared.h"
#include "support/sites/data_sets.h"
#include "support/sites/unit.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

class Conformance : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { SKIP_UNUSABLE(GetParam()); }

  BackendOptions options() const {
    BackendOptions chosen;
    chosen.name = GetParam();
    chosen.validation = true;
    return chosen;
  }

  static Session open(const BackendOptions& chosen) {
    auto session = Session::open(chosen);
    if (!session) throw std::runtime_error(session.error().message);
    return std::move(*session);
  }

  static Rendering render(Session& session, const Sites& sites, const RenderOptions& wanted) {
    auto rendering = session.render(sites, wanted);
    if (!rendering) throw std::runtime_error(rendering.error().message);
    EXPECT_EQ(rendering->report.validation_messages, std::vector<std::string>{});
    return std::move(*rendering);
  }

  static Rendering render(const Sites& sites, const RenderOptions& wanted, const BackendOptions& chosen) {
    auto session = open(chosen);
    return render(session, sites, wanted);
  }

  /// On one session for all tests of a process.
  Rendering render(const Sites& sites, const RenderOptions& wanted) {
    return render(Shared<Session>::get(GetParam(), [this] { return open(options()); }), sites, wanted);
  }

  Rendering expectRight(const Sites& sites, Box domain, int width = 96, int height = 96) {
    auto rendering = render(sites, pictureOf(domain, width, height));
    expectNearestEverywhere(rendering.image, sites, domain);
    const auto& report = rendering.report;
    EXPECT_EQ(report.ok + report.empty + report.duplicate, sites.size());
    return rendering;
  }
};

TEST_P(Conformance, randomSitesDrawTheNearestEverywhere) {
  for (const std::uint64_t n : {1u, 2u, 3u, 10u, 100u, 3000u}) {
    SCOPED_TRACE(testing::Message() << n << " sites");
    EXPECT_EQ(expectRight(generate(Pattern::random, n, 7), unit).report.ok, n);
  }
}

TEST_P(Conformance, patternsDrawTheNearestEverywhere) {
  for (const auto pattern :
       {Pattern::square, Pattern::hex, Pattern::jitter, Pattern::clusters, Pattern::circle}) {
    SCOPED_TRACE(testing::Message() << "pattern " << static_cast<int>(pattern));
    const auto sites = generate(pattern, 900, 3);
    EXPECT_EQ(expectRight(sites, unit, 150, 70).report.ok, sites.size());
  }
}

// From a fraction of a pixel to some pixels a cell: none, one or several centers are covered.
TEST_P(Conformance, cellsSmallerThanPixelsDrawTheNearestEverywhere) {
  for (const auto pattern : {Pattern::random, Pattern::square, Pattern::clusters}) {
    for (const auto& [count, side] : {std::pair(20000, 60), {5000, 60}, {2500, 50}, {2500, 100}}) {
      SCOPED_TRACE(testing::Message()
                   << "pattern " << static_cast<int>(pattern) << ", " << count << " sites");
      const auto sites = generate(pattern, static_cast<std::uint64_t>(count), 13);
      EXPECT_EQ(expectRight(sites, unit, side, side + 7).report.ok, sites.size());
    }
  }
}

TEST_P(Conformance, collinearSitesGiveStrips) {
  Sites sites;
  for (int i = 0; i < 50; ++i) {
    sites.x.push_back(0.1 + 0.3 * i / 50);
    sites.y.push_back(0.2 + 0.6 * i / 50);
  }
  EXPECT_EQ(expectRight(sites, unit).report.ok, 50u);
}

TEST_P(Conformance, aSiteBeyondTheReachOfFloatsTakesNothing) {
  auto sites = generate(Pattern::random, 16, 5);
  sites.x.push_back(1e25);
  sites.y.push_back(-3e24);
  EXPECT_EQ(expectRight(sites, unit).report.empty, 1u);
}

TEST_P(Conformance, equalSitesAreDuplicatesOfTheLowestIndex) {
  const Sites sites{std::vector<double>(20, 0.25), std::vector<double>(20, 0.75), {}};
  const auto rendering = expectRight(sites, unit);
  EXPECT_EQ(rendering.report.ok, 1u);
  EXPECT_EQ(rendering.report.duplicate, 19u);
  EXPECT_EQ(rendering.status[0], Status::ok);
  EXPECT_EQ(rendering.owner, std::vector<std::uint32_t>(20, 0));
  for (const auto id : rendering.image.ids) EXPECT_EQ(id, 0u);
}

TEST_P(Conformance, aFifthOfTheSitesMayBeDuplicates) {
  auto sites = generate(Pattern::random, 1000, 11);
  for (std::size_t i = 0; i < 200; ++i) {
    sites.x[5 * i + 4] = sites.x[i];
    sites.y[5 * i + 4] = sites.y[i];
  }
  const auto rendering = expectRight(sites, unit);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto owner = rendering.owner[i];
    EXPECT_LE(owner, i);
    EXPECT_EQ(rendering.status[i] == Status::duplicate, owner != i);
    EXPECT_EQ(sites.x[owner], sites.x[i]);
    EXPECT_EQ(sites.y[owner], sites.y[i]);
  }
}

TEST_P(Conformance, sitesOnTheBorderAndOutsideTakePart) {
  Sites sites{{0, 1, 0.5, 0.5, -0.5, 1.5, 3, 0.5}, {0, 1, 0, 0.5, 0.5, 0.5, 3, -40}, {}};
  const auto rendering = expectRight(sites, unit);
  using enum Status;
  EXPECT_EQ(rendering.status, (std::vector<Status>{ok, ok, ok, ok, empty, empty, empty, empty}));
}

TEST_P(Conformance, aDomainWithoutAnySiteInsideIsCovered) {
  expectRight(Sites{{5, 5.5, 7}, {-2, 3, 900}, {}}, unit);
  expectRight(Sites{{5e8, 5e8 + 1}, {0, 0.5}, {}}, unit);
}

TEST_P(Conformance, coordinatesOfAnyRangeKeepTheirCells) {
  const auto sites = generate(Pattern::random, 500, 5);
  const std::pair<double, double> ranges[] = {{1e-9, 0}, {1e12, 0}, {1e3, 5e6}, {1e-3, 77}, {3e-7, 0}};
  for (const auto& [scale, offset] : ranges) {
    SCOPED_TRACE(testing::Message() << scale << " at " << offset);
    Sites moved;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      moved.x.push_back(offset + scale * sites.x[i]);
      moved.y.push_back(-offset + scale * sites.y[i]);
    }
    expectRight(moved, {offset, -offset, offset + scale, -offset + scale});
  }
}

TEST_P(Conformance, sitesATrillionthOfTheDomainApartAreDistinct) {
  auto sites = generate(Pattern::random, 100, 9);
  for (int i = 0; i < 20; ++i) {
    sites.x.push_back(sites.x[static_cast<std::size_t>(i)] + 1e-12);
    sites.y.push_back(sites.y[static_cast<std::size_t>(i)] - 2e-12);
  }
  EXPECT_EQ(expectRight(sites, unit).report.ok, 120u);
}

TEST_P(Conformance, longThinCellsAreCertified) {
  Sites sites;
  for (int i = 1; i <= 400; ++i) {
    for (const double side : {-1.0, 1.0}) {
      sites.x.push_back(side * i);
      sites.y.push_back(-i);
    }
  }
  const Box domain{-440, -440, 440, 40};
  EXPECT_EQ(expectRight(sites, domain, 200, 109).report.ok, sites.size());
}

TEST_P(Conformance, aCellMayHaveThousandsOfNeighbors) {
  auto sites = generate(Pattern::circle, 1500, 1);
  sites.x.push_back(0.5);
  sites.y.push_back(0.5);
  EXPECT_EQ(expectRight(sites, unit, 120, 120).report.ok, 1501u);
}

TEST_P(Conformance, sitesSideBySideSeenFromAfarKeepTheirShape) {
  expectRight(Sites{{0.94, 0.94, 0.46, 0.94}, {0.9818, 0.9817, 0.9812, 0.9819}, {}}, unit, 400, 400);
  Sites cluster{{0.9, 0.5, 0.5 + 1e-9, 0.5 - 1e-9, 0.5}, {0.8, 0.5, 0.5, 0.5 + 1e-9, 0.5 - 1e-9}, {}};
  expectRight(cluster, unit, 400, 400);
}

TEST_P(Conformance, boardsWithFewDistinctCoordinatesAreCovered) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const auto random = generate(Pattern::random, 300, seed);
    Sites board;
    for (std::size_t i = 0; i < random.size(); ++i) {
      board.x.push_back(std::round(random.x[i] * 12) / 12);
      board.y.push_back(std::round(random.y[i] * 5000) / 5000);
    }
    expectRight(board, unit, 200, 150);
  }
}

TEST_P(Conformance, aRowOfSitesATrillionthApartIsCertified) {
  auto sites = generate(Pattern::random, 100, 2);
  for (int k = 0; k < 100; ++k) {
    sites.x.push_back(0.5 + 1e-12 * k);
    sites.y.push_back(0.5);
  }
  EXPECT_EQ(expectRight(sites, unit, 200, 200).report.ok, 200u);
}

TEST_P(Conformance, wedgesThatMeetInAPointStayWithinTheirBisectors) {
  const auto sites = generate(Pattern::circle, 700, 1);
  expectRight(sites, {0.495, 0.495, 0.505, 0.505}, 90, 90);
  expectRight(sites, unit, 401, 301);
}

TEST_P(Conformance, fewNeighborsAreDoubledUntilCertified) {
  const auto sites = generate(Pattern::random, 2000, 2);
  auto wanted = pictureOf(unit);
  wanted.search = {Search::flann, 15};
  const auto rendering = render(sites, wanted);
  EXPECT_EQ(rendering.report.ok, 2000u);
  EXPECT_GT(rendering.report.retried, 0u);
  expectNearestEverywhere(rendering.image, sites, unit);
}

TEST_P(Conformance, theSameInputGivesTheSameBytesForAnyThreadCount) {
  const auto sites = generate(Pattern::clusters, 3000, 4);
  auto one = options();
  one.threads = 1;
  auto two = options();
  two.threads = 2;
  const auto first = render(sites, pictureOf(unit, 200, 200), one);
  const auto second = render(sites, pictureOf(unit, 200, 200), two);
  EXPECT_EQ(first.image.ids, second.image.ids);
  EXPECT_EQ(first.image.rgba, second.image.rgba);
}

TEST_P(Conformance, aSmallTexelLimitGivesTheSameBytes) {
  const auto sites = generate(Pattern::random, 20000, 4);
  auto masked = options();
  masked.mask.limits = {{"maxTexelBufferElements", 65536}, {"maxStorageBufferRange", 1 << 20}};
  const auto free = render(sites, pictureOf(unit, 300, 300));
  const auto small = render(sites, pictureOf(unit, 300, 300), masked);
  EXPECT_EQ(free.image.ids, small.image.ids);
  EXPECT_EQ(free.image.rgba, small.image.rgba);
}

TEST_P(Conformance, aPictureLargerThanOneViewIsDrawnInParts) {
  const auto sites = generate(Pattern::random, 50, 6);
  auto masked = options();
  masked.mask.limits = {
      {"maxImageDimension2D", 64}, {"maxFramebufferWidth", 64}, {"maxFramebufferHeight", 64}};
  const auto rendering = render(sites, pictureOf(unit, 150, 100), masked);
  expectNearestEverywhere(rendering.image, sites, unit);
  EXPECT_EQ(rendering.report.ok, 50u);
}

TEST_P(Conformance, badInputIsRefused) {
  auto session = Session::open(options());
  ASSERT_TRUE(session) << session.error().message;
  const auto sites = generate(Pattern::random, 5, 1);
  const double nan = std::nan("");
  const auto refused = [&](const Sites& bad, const RenderOptions& wanted) {
    const auto result = session->render(bad, wanted);
    return !result && result.error().code == ErrorCode::input && !result.error().message.empty();
  };
  EXPECT_TRUE(refused({}, pictureOf(unit)));
  EXPECT_TRUE(refused({{0.5, nan}, {0.5, 0.5}, {}}, pictureOf(unit)));
  EXPECT_TRUE(refused(sites, pictureOf({1, 0, 0, 1})));
  EXPECT_TRUE(refused(sites, pictureOf({0, 0, 1, INFINITY})));
  EXPECT_TRUE(refused(sites, pictureOf(unit, 0, 10)));
  EXPECT_TRUE(refused(sites, pictureOf(unit, 10, 40000)));
}

TEST_P(Conformance, dataSetsDrawTheNearestEverywhere) {
  for (const auto& kind : dataSetKinds()) {
    SCOPED_TRACE(kind.name);
    const auto set = makeDataSet(kind.name, 500, 3);
    expectRight(set.sites, set.domain, 80, 80);
  }
}

/// With room for 4,096 texels the sites go to the device in tiles.
TEST_P(Conformance, sitesThatExceedTheDeviceAreDrawnInTiles) {
  auto masked = options();
  masked.mask.limits = {{"maxTexelBufferElements", 4096}, {"maxStorageBufferRange", 65536}};
  for (const char* name : {"random", "clusters", "crowded"}) {
    SCOPED_TRACE(name);
    const auto set = makeDataSet(name, 20000, 4);
    const auto rendering = render(set.sites, pictureOf(set.domain), masked);
    expectNearestEverywhere(rendering.image, set.sites, set.domain);
    EXPECT_EQ(rendering.report.ok, set.sites.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, Conformance, testing::ValuesIn(backend_names),
                         [](const auto& instance) { return testName(instance.param); });

}  // namespace
}  // namespace vorpipe::test
