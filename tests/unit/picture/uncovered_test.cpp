/// Pixels that a device left uncovered, or gave to no site.
#include "picture/draw_parts.h"

#include <gtest/gtest.h>

#include "backend/registry/registry.h"
#include "picture/picture.h"
#include "support/oracles/oracle.h"
#include "support/sites/random_sites.h"
#include "unit/fixtures/changed_cpu.h"

namespace vorpipe::test {

using namespace core;

namespace {

constexpr std::uint32_t left_color = 0x01020304;

/// The cpu backend, but pixels for which `keeps(pixel)` is false are spoiled when they are read: half of them
/// become uncovered, half get `wrong_id`.
class Patchy final : public ChangedCpu {
 public:
  using Keeps = bool (*)(std::size_t pixel);
  Patchy(Keeps keeps, std::uint32_t wrong_id)
      : ChangedCpu(1), keeps_(keeps), wrong_id_(wrong_id), info_(ChangedCpu::info()) {
    constexpr int several_views = 32;
    info_.max_view = several_views;
  }

  const BackendInfo& info() const override { return info_; }
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) override {
    if (auto read = ChangedCpu::read(rgba, ids); !read) return read;
    for (std::size_t pixel = 0; pixel < ids.size(); ++pixel) {
      if (keeps_(pixel)) continue;
      ids[pixel] = pixel % 2 == 0 ? no_site : wrong_id_;
      rgba[pixel] = left_color;
      ++left;
    }
    return {};
  }

  std::uint64_t left = 0;

 private:
  Keeps keeps_;
  std::uint32_t wrong_id_;
  BackendInfo info_;
};

Sites someSites(bool weighted) {
  Random random(5);
  Sites sites;
  for (int i = 0; i < 60; ++i) {
    add(sites, {-1 + 2 * random.uniform(), random.uniform()});
    if (weighted) sites.weight.push_back(0.01 * random.uniform());
  }
  // At the position of site 7; with weights it is the heavier one and owns the cell.
  add(sites, {sites.x[7], sites.y[7]});
  if (weighted) sites.weight.push_back(1);
  return sites;
}

RenderOptions picture() {
  RenderOptions options{};
  options.domain = {-1, 0, 1, 1};
  options.width = 90;
  options.height = 45;
  return options;
}

void expectSame(const Sites& sites, const RenderOptions& options, Patchy::Keeps keeps) {
  const auto exact = openExactTier(1);
  ChangedCpu whole(1);
  const auto right = renderOn({whole, *exact, 1}, sites, options);
  ASSERT_TRUE(right.has_value());
  EXPECT_EQ(right->report.pixels, 0u);
  for (const std::uint32_t wrong_id : {no_site - 1, 1000u, no_site}) {
    Patchy patchy(keeps, wrong_id);
    const auto mended = renderOn({patchy, *exact, 1}, sites, options);
    ASSERT_TRUE(mended.has_value());
    EXPECT_EQ(mended->image.ids, right->image.ids);
    EXPECT_EQ(mended->image.rgba, right->image.rgba);
    EXPECT_GT(patchy.left, 0u);
    EXPECT_EQ(mended->report.pixels, patchy.left);
  }
}

constexpr auto none = [](std::size_t) { return false; };
constexpr auto most = [](std::size_t pixel) { return pixel % 7 != 3; };

TEST(Uncovered, PixelsGetTheirNearestSite) {
  for (const bool weighted : {false, true}) {
    SCOPED_TRACE(weighted);
    expectSame(someSites(weighted), picture(), none);
    expectSame(someSites(weighted), picture(), most);
  }
}

TEST(Uncovered, PixelsOfAPeriodicDomainGetThatOfTheNearestImage) {
  auto options = picture();
  options.periodic = Periodic::xy;
  expectSame(someSites(false), options, most);
  expectSame(someSites(true), options, none);
}

TEST(Uncovered, PixelsHaveTheColorsOfTheirSites) {
  auto options = picture();
  options.color = ColorBy::area;
  options.edges = options.show_sites = true;
  expectSame(someSites(false), options, most);
}

TEST(Uncovered, PixelsOutsideAnOutlineStaySo) {
  auto options = picture();
  options.outline.points = {{-0.9, 0.1}, {0.8, 0.2}, {0.3, 0.9}};
  options.outline.ring_offsets = {0, 3};
  options.outline.polygon_offsets = {0, 1};
  expectSame(someSites(false), options, most);
}

}  // namespace
}  // namespace vorpipe::test
