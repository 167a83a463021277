#include "domain/pixel_mask.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {

using namespace core;

namespace {

RenderOptions picture(const Outline& outline, int width, int height) {
  RenderOptions options{};
  options.domain = {0, 0, 1, 1};
  options.outline = outline;
  options.width = width;
  options.height = height;
  return options;
}

/// By the textbook, edge by edge.
bool isInside(const Outline& outline, double x, double y) {
  bool inside = false;
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
    for (auto p = begin; p < end; ++p) {
      const Point a = outline.points[p], b = outline.points[p + 1 < end ? p + 1 : begin];
      if ((a.y > y) == (b.y > y)) continue;
      if (x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
  }
  return inside;
}

TEST(OutlineMask, pixelsBeyondHaveNoSiteAndNoColor) {
  for (const auto& [width, height] : {std::pair{1, 1}, {40, 33}, {333, 257}}) {
    const Outline outline = country(3000);
    const Sites sites = generate(Pattern::random, 300, 2);
    const Rendering masked = drawn(sites, picture(outline, width, height));
    const Rendering whole = drawn(sites, picture({}, width, height));
    std::size_t pixel = 0, outside = 0;
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column, ++pixel) {
        const bool inside = isInside(outline, (column + 0.5) / width, 1 - (row + 0.5) / height);
        outside += inside ? 0 : 1;
        ASSERT_EQ(masked.image.ids[pixel], inside ? whole.image.ids[pixel] : no_site)
            << row << ", " << column;
        ASSERT_EQ(masked.image.rgba[pixel], inside ? whole.image.rgba[pixel] : 0u);
      }
    }
    if (width > 1) {
      EXPECT_GT(outside, pixel / 3);
      EXPECT_LT(outside, pixel);
    }
  }
}

TEST(OutlineMask, aCenterOnAnEdgeBelongsToOneSide) {
  // Centers lie at multiples of 1/8 + 1/16, and so do the shared edges of the two outlines.
  const double middle = 0.4375;
  const Sites sites = generate(Pattern::random, 20, 2);
  const auto ids = [&](const RingPoints& ring) {
    return drawn(sites, picture(outlineOf({{ring}}), 8, 8)).image.ids;
  };
  const auto left = ids(rectangle(0, 0, middle, 1)), right = ids(rectangle(middle, 0, 1, 1));
  const auto below = ids({{0, 0}, {1, 1}, {0, 1}}), above = ids({{0, 0}, {1, 0}, {1, 1}});
  for (std::size_t pixel = 0; pixel < left.size(); ++pixel) {
    EXPECT_NE(left[pixel] == no_site, right[pixel] == no_site) << pixel;
    EXPECT_NE(below[pixel] == no_site, above[pixel] == no_site) << pixel;
  }
}

TEST(OutlineMask, edgesAndDotsStayInside) {
  RenderOptions options = picture(country(500), 120, 100);
  options.edges = true;
  options.show_sites = true;
  const Rendering rendering = drawn(generate(Pattern::random, 200, 3), options);
  std::size_t edge_pixels = 0;
  for (std::size_t pixel = 0; pixel < rendering.image.ids.size(); ++pixel) {
    if (rendering.image.ids[pixel] == no_site) {
      EXPECT_EQ(rendering.image.rgba[pixel], 0u);
    }
    edge_pixels += rendering.image.rgba[pixel] == 0xFF181818u;
  }
  EXPECT_GT(edge_pixels, 500U);
}

TEST(OutlineMask, statusesAreThoseOfTheClippedCells) {
  const Outline outline = country(500);
  const Sites sites = mixedSites();
  const RenderOptions options = picture(outline, 50, 50);
  CellsOptions cells{};
  cells.domain = options.domain;
  cells.outline = outline;
  const Diagram diagram = cellsOf(sites, cells);
  const Rendering rendering = drawn(sites, options);
  EXPECT_EQ(rendering.status, diagram.status);
  EXPECT_EQ(rendering.report.ok, diagram.report.ok);
  EXPECT_EQ(rendering.report.empty, diagram.report.empty);
  EXPECT_EQ(rendering.report.duplicate, diagram.report.duplicate);
  EXPECT_LT(rendering.report.ok, sites.size());
}

TEST(OutlineMask, checkKnowsWhichPixelsHaveASite) {
  const Sites sites = mixedSites();
  const RenderOptions options = picture(country(500), 70, 60);
  Rendering rendering = drawn(sites, options);
  EXPECT_EQ(*check(sites, options, rendering), std::vector<std::string>{});
  const auto inside = std::ranges::find_if(rendering.image.ids, [](auto id) { return id != no_site; });
  const auto id = std::exchange(*inside, no_site);
  EXPECT_THAT(promisesOf(check(sites, options, rendering)), testing::Contains("pixels"));
  *inside = id;
  rendering.image.ids[0] = id;
  EXPECT_THAT(promisesOf(check(sites, options, rendering)), testing::Contains("pixels"));
}

}  // namespace
}  // namespace vorpipe::test
