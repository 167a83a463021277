#include <geos_c.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "checked_runs.h"
#include "outlines.h"

namespace vorpipe::test {
namespace {

CellsOptions inside(const Outline& outline, const Box& domain = {0, 0, 1, 1}) {
  CellsOptions options{};
  options.domain = domain;
  options.outline = outline;
  return options;
}

/// Another way to the same areas: GEOS, cell by cell.
class GeosClip {
 public:
  explicit GeosClip(const Outline& outline) : geos_(GEOS_init_r()) {
    std::vector<GEOSGeometry*> polygons;
    for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
      std::vector<GEOSGeometry*> rings;
      for (auto r = outline.polygon_offsets[p]; r < outline.polygon_offsets[p + 1]; ++r) {
        const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
        rings.push_back(ring(std::span(outline.points).subspan(begin, end - begin)));
      }
      polygons.push_back(GEOSGeom_createPolygon_r(geos_, rings[0], rings.data() + 1,
                                                  static_cast<unsigned>(rings.size() - 1)));
    }
    outline_ = GEOSGeom_createCollection_r(geos_, GEOS_MULTIPOLYGON, polygons.data(),
                                           static_cast<unsigned>(polygons.size()));
  }
  GeosClip(const GeosClip&) = delete;
  GeosClip& operator=(const GeosClip&) = delete;
  ~GeosClip() {
    GEOSGeom_destroy_r(geos_, outline_);
    GEOS_finish_r(geos_);
  }

  struct Left {
    double area = 0, length = 0;
    int parts = 0;
  };
  Left clip(std::span<const Point> cell) {
    GEOSGeometry* polygon = GEOSGeom_createPolygon_r(geos_, ring(cell), nullptr, 0);
    GEOSGeometry* left = GEOSIntersection_r(geos_, polygon, outline_);
    Left result;
    GEOSArea_r(geos_, left, &result.area);
    GEOSLength_r(geos_, left, &result.length);
    for (int k = 0; k < GEOSGetNumGeometries_r(geos_, left); ++k) {
      // Where the cell touches the outline, points and lines may be left besides.
      const GEOSGeometry* part = GEOSGetGeometryN_r(geos_, left, k);
      result.parts += GEOSGeomTypeId_r(geos_, part) == GEOS_POLYGON && GEOSisEmpty_r(geos_, part) == 0;
    }
    GEOSGeom_destroy_r(geos_, left);
    GEOSGeom_destroy_r(geos_, polygon);
    return result;
  }

 private:
  GEOSGeometry* ring(std::span<const Point> points) {
    std::vector<Point> closed(points.begin(), points.end());
    closed.push_back(closed[0]);
    return GEOSGeom_createLinearRing_r(
        geos_,
        GEOSCoordSeq_copyFromBuffer_r(geos_, &closed[0].x, static_cast<unsigned>(closed.size()), 0, 0));
  }
  GEOSContextHandle_t geos_;
  GEOSGeometry* outline_ = nullptr;
};

/// Rings close, outer ones with their holes; edges are common to two cells, on the outline or on a wall; the
/// measures are those of the rings.
void expectWhole(const Diagram& d) {
  std::map<std::array<double, 6>, int> sides;  // from, to, site, neighbor
  for (std::size_t i = 0; i < d.status.size(); ++i) {
    const auto bounds = ringBounds(d, i);
    double area = 0, perimeter = 0;
    for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
      const auto ring = std::span(d.vertices).subspan(bounds[r], bounds[r + 1] - bounds[r]);
      area += ringArea(ring);
      if (r == 0) {
        EXPECT_GT(ringArea(ring), 0) << "site " << i;
      }
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = ring[k], b = ring[(k + 1) % ring.size()];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        EXPECT_NEAR(d.edge_lengths[bounds[r] + k], length, 1e-15) << "site " << i;
        perimeter += length;
        const auto neighbor = d.neighbors[bounds[r] + k];
        if (neighbor < 0) continue;
        ++sides[{a.x, a.y, b.x, b.y, static_cast<double>(i), static_cast<double>(neighbor)}];
      }
    }
    EXPECT_EQ(d.status[i] == Status::ok, area > 0) << "site " << i;
    EXPECT_NEAR(d.area[i], area, 1e-13 + 1e-12 * area) << "site " << i;
    EXPECT_NEAR(d.perimeter[i], perimeter, 1e-12 * (1 + perimeter)) << "site " << i;
  }
  for (const auto& [side, count] : sides) {
    const auto& [ax, ay, bx, by, site, neighbor] = side;
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(sides.contains({bx, by, ax, ay, neighbor, site})) << site << " and " << neighbor;
  }
}

void expectAsGeos(const Sites& sites, const Outline& outline, const Box& domain = {0, 0, 1, 1}) {
  const Diagram clipped = cellsOf(sites, inside(outline, domain));
  const Diagram boxed = cellsOf(sites, inside({}, domain));
  GeosClip geos(outline);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto begin = boxed.cell_offsets[i], end = boxed.cell_offsets[i + 1];
    if (end - begin < 3) continue;
    const auto left = geos.clip(std::span(boxed.vertices).subspan(begin, end - begin));
    ASSERT_NEAR(clipped.area[i], left.area, 1e-14 + 1e-12 * left.area) << "site " << i;
    if (left.area < 1e-13) continue;
    EXPECT_EQ(clipped.status[i], Status::ok);
    EXPECT_NEAR(clipped.perimeter[i], left.length, 1e-10 + 1e-12 * left.length) << "site " << i;
    const auto bounds = ringBounds(clipped, i);
    int parts = 0;
    for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
      parts += ringArea(std::span(clipped.vertices).subspan(bounds[r], bounds[r + 1] - bounds[r])) > 0;
    }
    EXPECT_EQ(parts, left.parts) << "site " << i;
  }
  expectWhole(clipped);
}

TEST(OutlineCells, aCountryWithLakesAndIslandsIsAsGeosClipsIt) {
  for (const std::size_t points : {100U, 1000U, 20000U}) {
    for (const std::uint64_t count : {1U, 7U, 300U, 3000U}) {
      SCOPED_TRACE(testing::Message() << points << " points, " << count << " sites");
      const Outline outline = country(points);
      expectAsGeos(generate(Pattern::random, count, count), outline);
      const Diagram d = cellsOf(generate(Pattern::random, count, count), inside(outline));
      EXPECT_NEAR(areaSum(d), outlineArea(outline), 1e-12);
    }
  }
}

TEST(OutlineCells, otherPatternsAndWeightsAreClippedToo) {
  const Outline outline = country(500, 7);
  for (const Pattern pattern : {Pattern::square, Pattern::hex, Pattern::clusters, Pattern::circle}) {
    expectAsGeos(generate(pattern, 900, 3), outline);
  }
  Sites weighted = generate(Pattern::random, 900, 3);
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    weighted.weight.push_back(static_cast<double>(i % 10) * 1e-4);
  }
  expectAsGeos(weighted, outline);
}

TEST(OutlineCells, anOutlineAlongBisectorsIsNoCellsNeighbor) {
  // The bisectors of the lattice are multiples of 1/8, and the outline runs along some of them.
  const Sites lattice = generate(Pattern::square, 64, 1);
  const Diagram d = cellsOf(lattice, inside(outlineOf({{rectangle(0.25, 0.25, 0.75, 0.625)}})));
  EXPECT_EQ(d.report.ok, 12U);
  EXPECT_EQ(d.report.empty, 52U);
  int along = 0;
  for (std::size_t i = 0; i < d.status.size(); ++i) {
    EXPECT_EQ(d.area[i], d.status[i] == Status::ok ? 1.0 / 64 : 0.0);
    for (auto e = d.cell_offsets[i]; e < d.cell_offsets[i + 1]; ++e) along += d.neighbors[e] == wall_outline;
  }
  EXPECT_EQ(along, 14);
  expectWhole(d);
}

TEST(OutlineCells, pointsOfTheOutlineMayLieOnVerticesAndEdges) {
  const Sites lattice = generate(Pattern::square, 64, 1);
  // Its points are vertices of cells, its sides their diagonals.
  const Outline diamond = outlineOf({{{{0.5, 0.125}, {0.875, 0.5}, {0.5, 0.875}, {0.125, 0.5}},
                                      {{0.5, 0.375}, {0.625, 0.5}, {0.5, 0.625}, {0.375, 0.5}}}});
  const Diagram d = cellsOf(lattice, inside(diamond));
  EXPECT_NEAR(areaSum(d), outlineArea(diamond), 1e-15);
  expectWhole(d);
  expectAsGeos(lattice, diamond);
  const Outline stairs = outlineOf({{{{0.25, 0.25},
                                      {0.75, 0.25},
                                      {0.75, 0.5},
                                      {0.5, 0.5},
                                      {0.5, 0.3125},
                                      {0.375, 0.3125},
                                      {0.375, 0.5},
                                      {0.25, 0.5}}}});
  expectAsGeos(lattice, stairs);
}

TEST(OutlineCells, lakesAndIslandsInsideOneCellAreItsRings) {
  Sites one;
  one.x = {0.5};
  one.y = {0.5};
  const Outline outline = outlineOf({{rectangle(0.1, 0.1, 0.9, 0.9), rectangle(0.2, 0.2, 0.6, 0.6)},
                                     {rectangle(0.3, 0.3, 0.5, 0.5), rectangle(0.35, 0.35, 0.4, 0.4)},
                                     {rectangle(0.92, 0.92, 0.94, 0.95)}});
  const Diagram d = cellsOf(one, inside(outline));
  ASSERT_EQ(d.ring_starts.size(), 5U);
  EXPECT_EQ(d.ring_starts, (std::vector<std::uint64_t>{0, 4, 8, 12, 16}));
  const std::vector<double> areas{0.64, -0.16, 0.04, -0.0025, 0.0006};
  for (std::size_t r = 0; r < 5; ++r) {
    EXPECT_NEAR(ringArea(std::span(d.vertices).subspan(4 * r, 4)), areas[r], 1e-15);
  }
  EXPECT_NEAR(d.area[0], outlineArea(outline), 1e-15);
  EXPECT_TRUE(std::ranges::all_of(d.neighbors, [](auto n) { return n == wall_outline; }));
}

TEST(OutlineCells, momentsAreThoseOfTheRingsTogether) {
  Sites one;
  one.x = {0.5};
  one.y = {0.5};
  const Diagram frame =
      cellsOf(one, inside(outlineOf({{rectangle(0, 0, 1, 1), rectangle(0.25, 0.25, 0.75, 0.75)}})));
  EXPECT_NEAR(frame.centroid[0].x, 0.5, 1e-15);
  EXPECT_NEAR(frame.second_moments[0][0], (1 - 1.0 / 16) / 12, 1e-15);
  EXPECT_NEAR(frame.second_moments[0][1], 0, 1e-15);
  const Diagram two =
      cellsOf(one, inside(outlineOf({{rectangle(0, 0, 0.5, 0.5)}, {rectangle(0.5, 0.5, 1, 0.75)}})));
  EXPECT_NEAR(two.centroid[0].x, (0.25 * 0.25 + 0.125 * 0.75) / 0.375, 1e-15);
  EXPECT_NEAR(two.centroid[0].y, (0.25 * 0.25 + 0.125 * 0.625) / 0.375, 1e-15);
}

TEST(OutlineCells, anOutlineAroundTheDomainChangesNothing) {
  const Sites sites = mixedSites();
  const Diagram boxed = cellsOf(sites, inside({}));
  for (const double margin : {0.0, 0.25}) {
    const Diagram d =
        cellsOf(sites, inside(outlineOf({{rectangle(-margin, -margin, 1 + margin, 1 + margin)}})));
    EXPECT_EQ(d.status, boxed.status);
    EXPECT_EQ(d.cell_offsets, boxed.cell_offsets);
    for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_NEAR(d.area[i], boxed.area[i], 1e-16);
    std::vector<std::int64_t> a = d.neighbors, b = boxed.neighbors;
    std::ranges::sort(a);
    std::ranges::sort(b);
    EXPECT_EQ(a, b);
    EXPECT_EQ(d.triangles, boxed.triangles);
  }
}

TEST(OutlineCells, cellsAreClippedToTheBoxAndTheOutline) {
  const Outline outline = country(1000);
  const Box box{0.3, 0.25, 0.7, 0.8};
  const Sites sites = generate(Pattern::random, 500, 5);
  expectAsGeos(sites, outline, box);
  const Diagram beyond = cellsOf(sites, inside(outline, {2, 2, 3, 3}));
  EXPECT_EQ(beyond.report.ok, 0U);
  EXPECT_EQ(beyond.cell_offsets.back(), 0U);
}

TEST(OutlineCells, unitsDoNotMatter) {
  const Outline outline = country(1000);
  const Sites sites = generate(Pattern::random, 500, 5);
  const Diagram plain = cellsOf(sites, inside(outline));
  const double factor = std::ldexp(1.0, -300);
  Outline small = outline;
  for (Point& p : small.points) p = {p.x * factor, p.y * factor};
  Sites small_sites = sites;
  for (double& x : small_sites.x) x *= factor;
  for (double& y : small_sites.y) y *= factor;
  const Diagram scaled = cellsOf(small_sites, inside(small, {0, 0, factor, factor}));
  EXPECT_EQ(scaled.neighbors, plain.neighbors);
  EXPECT_EQ(scaled.ring_starts, plain.ring_starts);
  for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_EQ(scaled.area[i], plain.area[i] * factor * factor);
  Outline far = outline;
  for (Point& p : far.points) p = {p.x * 1000 + 4e5, p.y * 1000 + 5e6};
  Sites far_sites = sites;
  for (double& x : far_sites.x) x = x * 1000 + 4e5;
  for (double& y : far_sites.y) y = y * 1000 + 5e6;
  const Diagram moved = cellsOf(far_sites, inside(far, {4e5, 5e6, 4e5 + 1000, 5e6 + 1000}));
  EXPECT_NEAR(areaSum(moved) / outlineArea(far), 1, 1e-9);
  EXPECT_EQ(moved.neighbors.size(), plain.neighbors.size());
}

TEST(OutlineCells, cellsNearTheSizeOfRoundingAreClippedToo) {
  // Their vertices are multiples of some 1e-16, so that many are no convex polygons any more.
  for (const double spread : {1e-9, 1e-12, 1e-14}) {
    Sites sites = generate(Pattern::random, 400, 6);
    for (double& x : sites.x) x = 0.5 + spread * (x - 0.5);
    for (double& y : sites.y) y = 0.5 + spread * (y - 0.5);
    const Outline outline = outlineOf({{{{0.2, 0.1}, {0.9, 0.2}, {0.5, 0.5 + spread / 7}, {0.45, 0.9}}}});
    const Diagram d = cellsOf(sites, inside(outline));
    EXPECT_NEAR(areaSum(d), outlineArea(outline), 1e-13) << spread;
    for (const double area : d.area) EXPECT_GE(area, 0);
  }
}

TEST(OutlineCells, manyLakesAndIslandsInFewCells) {
  // A lake in each square, and an island in each lake.
  std::vector<std::vector<RingPoints>> polygons{{rectangle(0, 0, 1, 1)}};
  const int side = 60;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double x = static_cast<double>(column) / side, y = static_cast<double>(row) / side,
                   u = 0.1 / side;
      polygons[0].push_back(rectangle(x + u, y + u, x + 9 * u, y + 9 * u));
      polygons.push_back({rectangle(x + 2 * u, y + 2 * u, x + 8 * u, y + 8 * u)});
    }
  }
  const Outline outline = outlineOf(polygons);
  for (const std::uint64_t count : {1U, 2U, 50U}) expectAsGeos(generate(Pattern::random, count, 11), outline);
}

TEST(OutlineCells, threadsAndDetailDoNotMatter) {
  const Outline outline = country(2000);
  const Sites sites = generate(Pattern::random, 5000, 9);
  CellsOptions options = inside(outline);
  std::vector<Diagram> runs;
  for (const int threads : {1, 3}) {
    BackendOptions backend;
    backend.name = "cpu";
    backend.threads = threads;
    runs.push_back(std::move(*Session::open(backend)->cells(sites, options)));
  }
  EXPECT_EQ(runs[0].neighbors, runs[1].neighbors);
  EXPECT_EQ(runs[0].ring_starts, runs[1].ring_starts);
  EXPECT_EQ(runs[0].area, runs[1].area);
  EXPECT_EQ(runs[0].edge_lengths, runs[1].edge_lengths);
  options.detail = Detail::measures;
  const Diagram measures = cellsOf(sites, options);
  EXPECT_EQ(measures.area, runs[0].area);
  EXPECT_EQ(measures.neighbors, runs[0].neighbors);
  EXPECT_TRUE(measures.vertices.empty());
  EXPECT_TRUE(measures.ring_starts.empty());
  EXPECT_TRUE(measures.perimeter.empty());
}

TEST(OutlineCells, checkFindsNothingWrong) {
  const Outline outline = country(2000);
  Sites weighted = generate(Pattern::random, 900, 3);
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    weighted.weight.push_back(static_cast<double>(i % 10) * 1e-4);
  }
  const auto expectRight = [&](const Sites& sites, Detail detail) {
    CellsOptions options = inside(outline);
    options.detail = detail;
    EXPECT_THAT(*check(sites, options, cellsOf(sites, options)), testing::IsEmpty());
  };
  for (const Detail detail : {Detail::measures, Detail::polygons, Detail::everything}) {
    for (const Sites& sites :
         {mixedSites(), generate(Pattern::hex, 3000, 1), generate(Pattern::circle, 500, 1)}) {
      expectRight(sites, detail);
    }
  }
  expectRight(weighted, Detail::polygons);
}

TEST(OutlineCells, checkFindsWhatIsWrong) {
  const Sites sites = mixedSites();
  const CellsOptions options = inside(country(2000));
  const Diagram right = cellsOf(sites, options);
  const auto broken = [&](const auto& change) {
    Diagram d = right;
    change(d);
    return promisesOf(check(sites, options, d));
  };
  std::size_t along = 0, between = 0;
  while (right.neighbors[along] != wall_outline) ++along;
  while (right.neighbors[between] < 0) ++between;
  using testing::Contains;
  EXPECT_THAT(broken([&](Diagram& d) { d.vertices[along].x += 1e-3; }), Contains("rings"));
  EXPECT_THAT(broken([&](Diagram& d) { d.neighbors[between] = wall_outline; }), Contains("edges"));
  EXPECT_THAT(broken([&](Diagram& d) { d.neighbors[along] = wall_xmin; }), Contains("edges"));
  EXPECT_THAT(broken([&](Diagram& d) { d.area[7] += 1e-8; }),
              testing::AllOf(Contains("areas"), Contains("rings")));
  EXPECT_THAT(broken([&](Diagram& d) { d.ring_starts.erase(d.ring_starts.begin()); }), Contains("rings"));
  CellsOptions bare = options;
  bare.outline = {};
  EXPECT_THAT(promisesOf(check(sites, options, cellsOf(sites, bare))), Contains("areas"));
}

std::string refusalOf(const Outline& outline, Periodic periodic = Periodic::none) {
  CellsOptions options = inside(outline);
  options.periodic = periodic;
  const auto cells = cpuSession().cells(generate(Pattern::random, 10, 1), options);
  if (cells) return "accepted";
  EXPECT_EQ(cells.error().code, ErrorCode::input);
  return cells.error().message;
}

TEST(OutlineCells, outlinesThatAreNoPolygonsAreRefusedWithThePlace) {
  const auto has = [](const std::string& text) { return testing::HasSubstr(text); };
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}})), has("at (0.5, 0.5)"));
  EXPECT_THAT(refusalOf(outlineOf({{rectangle(0, 0, 0.5, 0.5)}, {rectangle(0.25, 0.25, 1, 1)}})),
              testing::AnyOf(has("at (0.25, 0.5)"), has("at (0.5, 0.25)")));
  EXPECT_THAT(refusalOf(outlineOf({{rectangle(0, 0, 1, 1)}, {rectangle(0.25, 0.25, 0.5, 0.5)}})),
              has(" at ("));
  EXPECT_THAT(refusalOf(outlineOf({{rectangle(0, 0, 0.5, 0.5), rectangle(0.6, 0.6, 0.7, 0.7)}})),
              has(" at ("));
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 1}}}})), has("ring 0 has 2 points"));
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {0.5, 0.5}, {1, 1}}}})), has(" at ("));
  EXPECT_THAT(refusalOf(outlineOf({{{{0, 0}, {1, 0}, {NAN, 1}}}})), has("point 2 of ring 0 is not finite"));
  Outline ringless = outlineOf({{rectangle(0, 0, 1, 1)}});
  ringless.polygon_offsets = {0, 0, 1};
  EXPECT_THAT(refusalOf(ringless), has("polygon 0 has no rings"));
  EXPECT_THAT(refusalOf(outlineOf({{rectangle(0, 0, 1, 1)}}), Periodic::x), has("periodic"));
  Outline open = outlineOf({{rectangle(0, 0, 1, 1)}});
  open.ring_offsets.back() = 3;
  EXPECT_THAT(refusalOf(open), has("offsets"));
}

}  // namespace
}  // namespace vorpipe::test
