/// Sites that a view is drawn from, grids that pixels are found with, and polygons that are cut to a view.
#include "picture/near_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "backend/exact_tier.h"
#include "backend/registry/registry.h"
#include "picture/pixel_polygon.h"
#include "sites/site_set.h"
#include "support/sites/unit.h"
#include "vorpipe.h"

namespace vorpipe::test {

using namespace core;

namespace {

SiteSet setOf(const Sites& sites) { return std::move(prepare(sites, unit, 2)->set); }

View viewOf(const Box& box, int width, int height) {
  return {{0, 0, box.xmax - box.xmin, box.ymax - box.ymin}, width, height, {}, {box.xmin, box.ymin}};
}

const std::vector<Box> boxes = {{0.2, 0.3, 0.4, 0.5},       {0, 0.9, 0.1, 1},
                                {0.5, 0.5, 0.5001, 0.5001}, {0.3, 0.7, 0.3 + 1e-9, 0.701},
                                {0.99, 0.01, 1, 0.012},     {0.1, 0.1, 0.9, 0.9}};

TEST(NearView, HasTheNearestSiteOfEveryPixel) {
  for (const auto pattern : {Pattern::random, Pattern::clusters, Pattern::circle, Pattern::square}) {
    for (const std::uint64_t n : {1u, 5u, 400u, 3000u})
      for (const double weight : {0.0, 1e-5, 1e-2}) {
        Sites sites = generate(pattern, n, 3);
        if (weight > 0) sites.weight = generate(Pattern::random, sites.size(), 5).x;
        for (double& each : sites.weight) each = weight * each * each;
        if (weight > 0) sites.weight.front() = 0.1;
        const SiteSet set = setOf(sites);
        for (const Box& box : boxes) {
          const auto near = sitesNear(set, box);
          EXPECT_TRUE(std::ranges::is_sorted(near));
          const View view = viewOf(box, 40, 30);
          std::vector<std::uint32_t> pixels(40 * 30), found(pixels.size());
          for (std::uint32_t k = 0; k < pixels.size(); ++k) pixels[k] = k;
          const auto exact = openExactTier(2);
          exact->take(set);
          exact->nearest(view, pixels, found);
          for (const auto site : found) ASSERT_TRUE(std::ranges::binary_search(near, site));
        }
      }
  }
}

TEST(NearView, LeavesOutWhatIsFar) {
  const SiteSet set = setOf(generate(Pattern::random, 100000, 3));
  EXPECT_LT(sitesNear(set, {0.5, 0.5, 0.51, 0.51}).size(), 100u);
  EXPECT_LT(sitesNear(set, {0.2, 0.2, 0.3, 0.3}).size(), 2000u);
  EXPECT_LT(sitesNear(set, {0.5, 0.5, 0.5 + 1e-9, 0.5 + 1e-9}).size(), 20u);
}

TEST(NearView, PixelsOfTheCpuAreTheJudges) {
  BackendOptions options;
  options.name = "cpu";
  const auto opened = openBackend(options);
  ASSERT_TRUE(opened);
  Backend& cpu = *opened->backend;
  for (const auto pattern :
       {Pattern::random, Pattern::clusters, Pattern::circle, Pattern::square, Pattern::hex}) {
    for (const std::uint64_t n : {1u, 60u, 3000u}) {
      const SiteSet set = setOf(generate(pattern, n, 9));
      const std::vector<std::uint8_t> colors(set.size());
      const auto exact = openExactTier(2);
      exact->take(set);
      for (const Box& box : boxes) {
        const View view = viewOf(box, 120, 60);
        std::vector<std::uint32_t> pixels(120 * 60), found(pixels.size()), ids(pixels.size()),
            rgba(ids.size());
        for (std::uint32_t k = 0; k < pixels.size(); ++k) pixels[k] = k;
        exact->nearest(view, pixels, found);
        for (auto& site : found) site = set.id[site];
        ASSERT_TRUE(cpu.upload(set, colors) && cpu.begin(view) && cpu.read(rgba, ids));
        ASSERT_EQ(ids, found) << "pattern " << static_cast<int>(pattern) << ", " << n << " sites";
      }
    }
  }
}

/// Twice the area, counter-clockwise.
double areaOf(const std::vector<Point>& polygon) {
  double twice = 0;
  Point before = polygon.empty() ? Point{} : polygon.back();
  for (const Point p : polygon) {
    twice += before.x * p.y - before.y * p.x;
    before = p;
  }
  return twice;
}

TEST(NearView, PolygonsAreCutFarBeyondTheView) {
  const PixelFrame frame({{0, 0, 1, 1}, 100, 50, {}, {0, 0}}, 8);
  std::vector<Point> inside{{10, 10}, {90, 10}, {50, 40}};
  const auto same = inside;
  cutToView(frame, inside);
  EXPECT_TRUE(inside == same);
  std::vector<Point> whole{{-1e12, -1e12}, {1e12, -1e12}, {0, 1e12}};
  cutToView(frame, whole);
  EXPECT_NEAR(areaOf(whole), 2 * 200 * 100, 1e-6);
  std::vector<Point> beside{{1e6, 0}, {1e7, 0}, {1e7, 10}};
  cutToView(frame, beside);
  EXPECT_TRUE(beside.empty());
  // Two halves of a plane meet on the same corners.
  std::vector<Point> left{{-1e9, -1e9}, {3e8, -1e9}, {-2.9999998e8, 1e9}, {-1e9, 1e9}};
  std::vector<Point> right{{3e8, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-2.9999998e8, 1e9}};
  cutToView(frame, left);
  cutToView(frame, right);
  const auto has = [](const std::vector<Point>& corners, Point p) {
    return std::ranges::find(corners, p) != corners.end();
  };
  EXPECT_EQ(std::ranges::count_if(left, [&](Point p) { return has(right, p); }), 2);
  EXPECT_NEAR(areaOf(left) + areaOf(right), 2 * 200 * 100, 1e-6);
}

TEST(NearView, FramesOfTheDomainHaveItsCenters) {
  RenderOptions options{};
  options.domain = unit;
  options.width = 100;
  options.height = 50;
  const auto same = [](const PictureFrame& a, const PictureFrame& b) {
    return a.left == b.left && a.top == b.top && a.width == b.width && a.height == b.height;
  };
  EXPECT_TRUE(same(domainFrame(options), {0, 0, 100, 50}));
  options.view = Box{-0.5, -0.5, 1.5, 1.5};
  // A row of centers lies on either wall, which is of the domain.
  EXPECT_TRUE(same(domainFrame(options), {25, 12, 50, 26}));
  options.view = Box{0.5, 0.5, 0.6, 0.6};
  options.fit = Fit::letterbox;
  EXPECT_TRUE(same(shownFrame(options), {25, 0, 50, 50}));
  EXPECT_TRUE(same(domainFrame(options), {25, 0, 50, 50}));
  options.view = Box{2, 0, 3, 1};
  EXPECT_EQ(domainFrame(options).width, 0);
  EXPECT_TRUE(checkView(options));
  options.view = Box{0, 0, 0, 1};
  EXPECT_FALSE(checkView(options));
}

}  // namespace
}  // namespace vorpipe::test
