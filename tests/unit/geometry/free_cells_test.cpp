#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/cpu_session.h"
#include "vorpipe.h"
#include "vorpipe/free_surface.h"

namespace vorpipe::test {
namespace {

using ::testing::HasSubstr;

constexpr double half_turn = std::numbers::pi;

CellsOptions wholeSquare() {
  CellsOptions options{};
  options.domain = {0, 0, 1, 1};
  return options;
}

Sites manyDrops() {
  Sites sites = generate(Pattern::random, 300, 11);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites.weight.push_back((0.3 + 0.9 * static_cast<double>(i % 7) / 6) / (half_turn * 300));
  }
  sites.weight[3] = 0;
  return sites;
}

TEST(FreeCells, NumbersAreThoseOfArcs) {
  Session session = cpuSession();
  const Sites sites = manyDrops();
  MovingCells moving(session, wholeSquare(), Surface::free);
  ASSERT_TRUE(moving.update(sites));
  const auto cells = freeCells(session, sites, wholeSquare(), 120);
  ASSERT_TRUE(cells) << cells.error().message;
  EXPECT_EQ(cells->status, moving.moments().status);
  EXPECT_EQ(cells->area, moving.moments().area);
  EXPECT_EQ(cells->centroid, moving.moments().centroid);
  EXPECT_EQ(cells->report.ok, moving.report().ok);
  std::size_t arcs = 0;
  for (const Cell cell : *cells) {
    const std::size_t i = cell.index();
    if (cell.status() != Status::ok) {
      EXPECT_EQ(cell.edges(), 0u);
      continue;
    }
    const Point site{sites.x[i], sites.y[i]};
    const double r = std::sqrt(sites.weight[i]), lost = 2 * half_turn / 120;
    double around = 0, twice_area = 0, arc = 0;
    for (std::size_t k = 0; k < cell.edges(); ++k) {
      const Point p = cell.vertices()[k], q = cell.vertices()[(k + 1) % cell.edges()];
      EXPECT_LE(std::hypot(p.x - site.x, p.y - site.y), r * (1 + 1e-12));
      around += cell.edgeLengths()[k];
      twice_area += (p.x - site.x) * (q.y - site.y) - (q.x - site.x) * (p.y - site.y);
    }
    for (const BorderPart& part : borderOf(cell, site)) {
      arc += part.angle;
      arcs += part.angle > 0 ? 1 : 0;
      EXPECT_EQ(part.angle > 0, part.neighbor == static_cast<std::int64_t>(Wall::outline));
    }
    EXPECT_NEAR(around, cell.perimeter(), 1e-14);
    EXPECT_NEAR(arc, moving.edges().arc[i], 1e-13);
    EXPECT_LE(twice_area / 2, cell.area() * (1 + 1e-12));
    EXPECT_GE(twice_area / 2, cell.area() - r * r * arc * lost * lost / 12 - 1e-16);
    EXPECT_NEAR(cell.secondMoments()[0] + cell.secondMoments()[2], moving.moments().spread[i],
                1e-13 * moving.moments().spread[i] + 1e-20);
  }
  EXPECT_GT(arcs, 250u);
  EXPECT_TRUE(hasFreeSurface(*cells, {}));
}

TEST(FreeCells, AWholeDiscIsOneArc) {
  Session session = cpuSession();
  const Sites sites{{0.5}, {0.5}, {0.0625}};
  const auto cells = freeCells(session, sites, wholeSquare(), 12);
  ASSERT_TRUE(cells) << cells.error().message;
  const Cell cell = cells->cell(0);
  EXPECT_EQ(cell.edges(), 12u);
  const auto border = borderOf(cell, {0.5, 0.5});
  ASSERT_EQ(border.size(), 1u);
  EXPECT_DOUBLE_EQ(border[0].angle, 2 * half_turn);
  EXPECT_EQ(border[0].from, border[0].to);
  EXPECT_DOUBLE_EQ(cell.area(), half_turn / 16);
  EXPECT_DOUBLE_EQ(cell.perimeter(), half_turn / 2);
  EXPECT_DOUBLE_EQ(cell.secondMoments()[0], half_turn / 1024);
  // A disc so large that the square is what cuts it has no arc at all.
  const auto filled = freeCells(session, {{0.5}, {0.5}, {2}}, wholeSquare());
  ASSERT_TRUE(filled);
  EXPECT_FALSE(hasFreeSurface(*filled, {}));
  EXPECT_EQ(filled->cell(0).edges(), 4u);
}

TEST(FreeCells, AirHasNoPixels) {
  Session session = cpuSession();
  const Sites sites = manyDrops();
  RenderOptions options{};
  options.domain = {0, 0, 1, 1};
  options.width = 300;
  options.height = 200;
  auto drawn = session.render(sites, options);
  ASSERT_TRUE(drawn);
  const Image whole = drawn->image;
  ASSERT_TRUE(takeOutAir(sites, options, drawn->image));
  std::size_t air = 0;
  for (std::size_t k = 0; k < whole.ids.size(); ++k) {
    const auto i = whole.ids[k];
    const double dx = (static_cast<double>(k % 300) + 0.5) / 300 - sites.x[i];
    const double dy = 1 - (static_cast<double>(k / 300) + 0.5) / 200 - sites.y[i];
    const bool is_air = dx * dx + dy * dy > sites.weight[i];
    air += is_air ? 1 : 0;
    ASSERT_EQ(drawn->image.ids[k], is_air ? no_site : i) << k;
    ASSERT_EQ(drawn->image.rgba[k], is_air ? 0u : whole.rgba[k]) << k;
  }
  const auto cells = freeCells(session, sites, wholeSquare());
  EXPECT_NEAR(static_cast<double>(air) / (300 * 200), 1 - areaSum(*cells), 2e-3);
  options.legend = true;
  const auto refused = takeOutAir(sites, options, drawn->image);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("takes no legend"));
}

TEST(FreeCells, PixelsAtTheSurfaceAreCoveredInPart) {
  Session session = cpuSession();
  const Sites sites{{0.5}, {0.5}, {0.09}};
  RenderOptions options{};
  options.domain = {0, 0, 1, 1};
  options.width = options.height = 40;
  options.antialias = 4;
  auto drawn = session.render(sites, options);
  ASSERT_TRUE(drawn);
  ASSERT_TRUE(takeOutAir(sites, options, drawn->image));
  double covered = 0;
  for (const std::uint32_t rgba : drawn->image.rgba) covered += (rgba >> 24) / 255.0;
  EXPECT_NEAR(covered / 1600, half_turn * 0.09, 2e-3);
}

TEST(FreeCells, AirIsWhiteWithWhateverWasDrawnThere) {
  Session session = cpuSession();
  const Sites sites{{0.5}, {0.5}, {0.09}};
  RenderOptions options{};
  options.domain = {0, 0, 1, 1};
  options.width = options.height = 40;
  options.show_sites = options.labels = true;
  for (const int antialias : {1, 4}) {
    options.antialias = antialias;
    auto drawn = session.render(sites, options);
    ASSERT_TRUE(drawn);
    const Image whole = drawn->image;
    whitenAir(sites, options, drawn->image);
    const std::uint32_t white = 0xFFFFFFFF;
    EXPECT_EQ(drawn->image.rgba.front(), white);
    EXPECT_EQ(drawn->image.ids.front(), no_site);
    const std::size_t middle = 20 * 40 + 20;
    EXPECT_EQ(drawn->image.rgba[middle], whole.rgba[middle]);
    EXPECT_EQ(drawn->image.ids[middle], 0U);
    const bool mixed = std::ranges::any_of(drawn->image.rgba, [&](std::uint32_t rgba) {
      return rgba != white && std::ranges::find(whole.rgba, rgba) == whole.rgba.end();
    });
    EXPECT_EQ(mixed, antialias > 1);
  }
}

}  // namespace
}  // namespace vorpipe::test
