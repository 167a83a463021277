// A device whose answers make no sense leads to right cells or to an error of the device, never to a crash or
// to wrong cells.
#include <gtest/gtest.h>

#include <memory>

#include "backend/registry/registry.h"
#include "conformance/cells_fixture.h"
#include "domain/cells_run.h"
#include "picture/picture.h"
#include "support/devices/lying_backend.h"
#include "support/oracles/oracle.h"

namespace vorpipe::test {

using namespace core;

namespace {

constexpr std::size_t site_count = 4000;

struct Case {
  const char* name;
  Sites sites;
  CellsOptions wanted;
  Mask mask;
};

std::vector<Case> cases() {
  const Mask tiles{{}, {{"maxTexelBufferElements", 1500}}};
  const auto random = generate(Pattern::random, site_count, 11);
  auto weighted = random;
  for (std::size_t i = 0; i < site_count; ++i) weighted.weight.push_back(1e-4 * static_cast<double>(i % 7));
  auto periodic = within(unit);
  periodic.periodic = Periodic::xy;
  const SearchOptions lists{Search::flann, 12};
  return {{"the grid", random, within(unit), {}},
          {"tiles", random, within(unit), tiles},
          {"lists", random, within(unit, lists), {}},
          {"weights", weighted, within(unit), {}},
          {"weights in tiles", weighted, within(unit), tiles},
          {"a periodic domain", random, periodic, tiles}};
}

RenderOptions pictureOf(const CellsOptions& cells) {
  RenderOptions picture{};
  picture.domain = cells.domain;
  picture.periodic = cells.periodic;
  picture.search = cells.search;
  picture.width = picture.height = 96;
  return picture;
}

void expectSameCells(const Diagram& mine, const Diagram& right) {
  ASSERT_EQ(mine.status, right.status);
  EXPECT_EQ(mine.cell_offsets, right.cell_offsets);
  EXPECT_EQ(mine.neighbors, right.neighbors);
  for (std::size_t i = 0; i < mine.area.size(); ++i) {
    ASSERT_NEAR(mine.area[i], right.area[i], 1e-12 + 1e-9 * right.area[i]) << "site " << i;
  }
}

class LyingBackends : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { SKIP_UNUSABLE(GetParam()); }

  static std::unique_ptr<Backend> open(const char* name, const Mask& mask) {
    BackendOptions options;
    options.name = name;
    options.mask = mask;
    auto opened = vorpipe::openBackend(options);
    if (!opened) throw std::runtime_error(opened.error().message);
    return std::move(opened->backend);
  }

  const std::uint64_t seed_ = static_cast<std::uint64_t>(testing::UnitTest::GetInstance()->random_seed());
};

TEST_P(LyingBackends, leadToRightCellsOrAnError) {
  const auto exact = openExactTier(0);
  for (const auto& given : cases()) {
    const auto honest = open(GetParam(), given.mask);
    const auto right = cellsOn({*honest, *exact, 0}, given.sites, given.wanted);
    ASSERT_TRUE(right) << right.error().message;
    for (const auto lie : lies) {
      if (lie == Lie::pixels) continue;
      for (const std::uint32_t one_in : {1u, 50u}) {
        SCOPED_TRACE(testing::Message() << given.name << ", lie " << static_cast<int>(lie) << ", one in "
                                        << one_in << ", seed " << seed_);
        LyingBackend lying(*honest, lie, one_in, seed_);
        const auto found = cellsOn({lying, *exact, 0}, given.sites, given.wanted);
        if (found) {
          expectSameCells(*found, *right);
        } else {
          EXPECT_EQ(found.error().code, ErrorCode::device) << found.error().message;
          EXPECT_EQ(found.error().message.find('\n'), std::string::npos);
        }
        // Only arrays that contradict each other are an error.
        EXPECT_TRUE(found || lie == Lie::offsets || lie == Lie::lengths) << found.error().message;
        EXPECT_TRUE(one_in > 1 || lying.told() > 0);
      }
    }
  }
}

TEST_P(LyingBackends, leadToNoPixelOfAnImpossibleSite) {
  const auto exact = openExactTier(0);
  for (const auto& given : cases()) {
    const auto picture = pictureOf(given.wanted);
    const auto honest = open(GetParam(), given.mask);
    const auto right = renderOn({*honest, *exact, 0}, given.sites, picture);
    ASSERT_TRUE(right) << right.error().message;
    for (const auto lie : {Lie::pixels, Lie::statuses}) {
      SCOPED_TRACE(testing::Message()
                   << given.name << ", lie " << static_cast<int>(lie) << ", seed " << seed_);
      LyingBackend lying(*honest, lie, 5, seed_);
      const auto drawn = renderOn({lying, *exact, 0}, given.sites, picture);
      if (!drawn) {
        // The device cannot be made to draw a cell that the judge found.
        EXPECT_EQ(drawn.error().code, ErrorCode::device) << drawn.error().message;
        continue;
      }
      EXPECT_GT(lying.told(), 0u);
      const auto& mine = drawn->image;
      for (std::size_t k = 0; k < mine.ids.size(); ++k) {
        ASSERT_TRUE(mine.ids[k] < given.sites.size() || mine.ids[k] == no_site) << "pixel " << k;
        if (lie != Lie::pixels || mine.ids[k] != right->image.ids[k]) continue;
        // Colors follow from the ids, whatever colors the device answered.
        ASSERT_EQ(mine.rgba[k], right->image.rgba[k]) << "pixel " << k;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, LyingBackends, testing::ValuesIn(backend_names),
                         [](const auto& backend) { return testName(backend.param); });

}  // namespace
}  // namespace vorpipe::test
