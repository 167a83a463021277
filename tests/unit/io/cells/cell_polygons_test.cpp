#include "io/cells/cell_polygons.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/sites/site_domain.h"
#include "unit/fixtures/checked_runs.h"
#include "vorpipe.h"

namespace vorpipe::test {
namespace {

/// Cells of sites in degrees, in their hull, by way of the plane amid them; and the sites again.
struct CellsOnEarth {
  PlacedSites placed;
  Diagram diagram;
};

CellsOnEarth cellsIn(const Sites& degrees, DomainSettings settings) {
  CellsOnEarth made;
  made.placed.sites = degrees;
  made.placed.from = SitesFrom::file;
  made.placed.system = wgs84();
  settings.project.emplace();
  const auto found = findDomain(settings, made.placed);
  EXPECT_TRUE(found) << found.error().message;
  CellsOptions options{};
  options.domain = made.placed.domain;
  options.outline = made.placed.outline;
  made.diagram = cellsOf(made.placed.sites, options);
  backToDegrees(made.placed, made.diagram);
  return made;
}

CellsOnEarth cellsInHull(const Sites& degrees, double margin) {
  DomainSettings settings;
  settings.hull = true;
  settings.margin = Margin{margin, true};
  return cellsIn(degrees, settings);
}

Outline outlineOf(const CellPolygons& polygons) {
  Outline outline;
  outline.ring_offsets = outline.polygon_offsets = {0};
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    for (const auto& ring : polygons[p]) {
      outline.points.insert(outline.points.end(), ring.begin(), ring.end());
      outline.ring_offsets.push_back(outline.points.size());
    }
    outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
  }
  return outline;
}

/// In one turn or another.
bool holds(const Outline& outline, Point site) {
  for (const double turn : {-360.0, 0.0, 360.0}) {
    bool inside = false;
    for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
      const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
      for (auto p = begin; p < end; ++p) {
        const Point a = outline.points[p], b = outline.points[p + 1 < end ? p + 1 : begin];
        if ((a.y > site.y) == (b.y > site.y)) continue;
        inside ^= site.x + turn < a.x + (b.x - a.x) * ((site.y - a.y) / (b.y - a.y));
      }
    }
    if (inside) return true;
  }
  return false;
}

/// The polygons are valid, on the Earth, and hold their sites.
void expectOnEarth(const CellsOnEarth& made, bool hold_sites = true) {
  for (std::size_t site = 0; site < made.placed.sites.size(); ++site) {
    if (made.diagram.status[site] != Status::ok) continue;
    const Outline outline = outlineOf(CellPolygons(made.placed.sites, made.diagram, site, made.placed.system));
    for (const Point point : outline.points) ASSERT_LE(std::abs(point.y), 90) << "site " << site;
    const auto valid = mended(outline, false);
    ASSERT_TRUE(valid) << "site " << site << ": " << valid.error().message;
    EXPECT_EQ(valid->changes, "") << site;
    const Point at{made.placed.sites.x[site], made.placed.sites.y[site]};
    if (hold_sites) {
      EXPECT_TRUE(holds(outline, at)) << site;
    }
  }
}

/// Around the north pole, and the same around the south.
void expectRight(Sites sites, double margin) {
  for (int pole = 0; pole < 2; ++pole) {
    for (double& y : sites.y) y = -y;
    const CellsOnEarth made = cellsInHull(sites, margin);
    expectOnEarth(made, margin > 0);
  }
}

TEST(CellPolygons, aroundAPoleAreValidAndHoldTheirSites) {
  const Sites five{{0, 120, -90, -140, 30}, {-75, -75, -85, -78, -89}, {}};
  expectRight(five, 0);
  expectRight(five, 0.1);
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    Sites sites = generate(Pattern::random, 9, seed);
    for (double& x : sites.x) x = 360 * x - 180;
    for (double& y : sites.y) y = 70 + 20 * y;
    expectRight(sites, 0);
    expectRight(sites, 0.1);
  }
}

/// Sites on one parallel: borders and corners lie at the pole, where there is no longitude.
TEST(CellPolygons, areRightWhereTheirBordersMeetAPole) {
  const std::vector<std::vector<double>> longitudes{{180, 160},
                                                    {-80, 90},
                                                    {-60, -5},
                                                    {0, 180},
                                                    {0, 90, 180, -90},
                                                    {30},
                                                    {-165, -135, -60, 40, 80, 120, 160, 170, 175}};
  for (const bool north : {true, false}) {
    for (const auto& x : longitudes) {
      for (const double latitude : {65.0, 80.0, 89.0}) {
        DomainSettings settings;
        settings.box = north ? Box{-180, 62, 180, 90} : Box{-180, -90, 180, -62};
        expectOnEarth(
            cellsIn({x, std::vector<double>(x.size(), north ? latitude : -latitude), {}}, settings));
      }
    }
  }
  // A pole that is a corner of the domain.
  DomainSettings wedge;
  wedge.outline = {{{20, 90}, {20, 66}, {95, 70}}, {0, 3}, {0, 1}};
  expectOnEarth(cellsIn({{40, 60}, {72, 72}, {}}, wedge));
}

/// What neighbors share stays shared: together they cover what they did.
TEST(CellPolygons, thatBendShareTheirPlaces) {
  const CellsOnEarth made = cellsInHull({{0, 120, -90, -140, 30}, {-75, -75, -85, -78, -89}, {}}, 0);
  Outline all;
  all.ring_offsets = all.polygon_offsets = {0};
  double sum = 0, bent = 0;
  for (std::size_t site = 0; site < 5; ++site) {
    const Outline outline = outlineOf(CellPolygons(made.placed.sites, made.diagram, site, made.placed.system));
    bent += static_cast<double>(outline.points.size());
    double twice = 0;
    for (std::size_t k = 0; k < outline.points.size(); ++k) {
      const Point a = outline.points[k], b = outline.points[(k + 1) % outline.points.size()];
      twice += a.x * b.y - b.x * a.y;
    }
    sum += twice / 2;
    // The cells lie in several turns, and meet in one.
    for (const double turn : {-360.0, 0.0, 360.0}) {
      for (Point point : outline.points) all.points.push_back({point.x + turn, point.y});
      all.ring_offsets.push_back(all.points.size());
      all.polygon_offsets.push_back(all.ring_offsets.size() - 1);
    }
  }
  EXPECT_GT(bent, 2.0 * static_cast<double>(made.diagram.vertices.size()));
  const auto whole = mended(all, false);
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->changes.find("overlap"), std::string::npos) << whole->changes;
  EXPECT_EQ(whole->outline.polygon_offsets.size(), 2u);
  EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace vorpipe::test
