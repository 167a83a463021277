#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "unit/domain/geos_clip.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/cpu_session.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

/// Rings close, outer ones with their holes; edges are common to two cells, on the outline or on a wall; the
/// measures are those of the rings, but areas, which are from before ties move corners by `moved`.
void expectWhole(const Diagram& d, double moved = 0) {
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
    EXPECT_NEAR(d.area[i], area, 1e-13 + 1e-12 * area + moved * perimeter) << "site " << i;
    EXPECT_NEAR(d.perimeter[i], perimeter, 1e-12 * (1 + perimeter)) << "site " << i;
  }
  for (const auto& [side, count] : sides) {
    const auto& [ax, ay, bx, by, site, neighbor] = side;
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(sides.contains({bx, by, ax, ay, neighbor, site})) << site << " and " << neighbor;
  }
}

double ringsArea(const Diagram& d, std::size_t i) {
  const auto bounds = ringBounds(d, i);
  double area = 0;
  for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
    area += ringArea(std::span(d.vertices).subspan(bounds[r], bounds[r + 1] - bounds[r]));
  }
  return area;
}

void expectAsGeos(const Sites& sites, const Outline& outline, const Box& domain = {0, 0, 1, 1},
                  double moved = 0) {
  const Diagram clipped = cellsOf(sites, inside(outline, domain));
  const Diagram boxed = cellsOf(sites, inside({}, domain));
  GeosClip geos(outline);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto begin = boxed.cell_offsets[i], end = boxed.cell_offsets[i + 1];
    if (end - begin < 3) continue;
    const auto left = geos.clip(std::span(boxed.vertices).subspan(begin, end - begin));
    ASSERT_NEAR(ringsArea(clipped, i), left.area, 1e-14 + 1e-12 * left.area) << "site " << i;
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
  expectWhole(clipped, moved);
}

TEST(OutlineCells, aCountryWithLakesAndIslandsIsAsGeosClipsIt) {
  for (const std::size_t points : {100U, 1000U, 5000U}) {
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
  constexpr double tied = 1e-6;
  for (const Pattern pattern : {Pattern::square, Pattern::hex, Pattern::clusters, Pattern::circle}) {
    expectAsGeos(generate(pattern, 900, 3), outline, {0, 0, 1, 1}, tied);
  }
  Sites weighted = generate(Pattern::random, 900, 3);
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    weighted.weight.push_back(static_cast<double>(i % 10) * 1e-4);
  }
  expectAsGeos(weighted, outline, {0, 0, 1, 1}, tied);
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
  const Diagram as_it_is = cellsOf(sites, inside(outline));
  const double factor = std::ldexp(1.0, -300);
  Outline small = outline;
  for (Point& p : small.points) p = {p.x * factor, p.y * factor};
  Sites small_sites = sites;
  for (double& x : small_sites.x) x *= factor;
  for (double& y : small_sites.y) y *= factor;
  const Diagram scaled = cellsOf(small_sites, inside(small, {0, 0, factor, factor}));
  EXPECT_EQ(scaled.neighbors, as_it_is.neighbors);
  EXPECT_EQ(scaled.ring_starts, as_it_is.ring_starts);
  for (std::size_t i = 0; i < sites.size(); ++i)
    EXPECT_EQ(scaled.area[i], as_it_is.area[i] * factor * factor);
  Outline far = outline;
  for (Point& p : far.points) p = {p.x * 1000 + 4e5, p.y * 1000 + 5e6};
  Sites far_sites = sites;
  for (double& x : far_sites.x) x = x * 1000 + 4e5;
  for (double& y : far_sites.y) y = y * 1000 + 5e6;
  const Diagram moved = cellsOf(far_sites, inside(far, {4e5, 5e6, 4e5 + 1000, 5e6 + 1000}));
  EXPECT_NEAR(areaSum(moved) / outlineArea(far), 1, 1e-9);
  EXPECT_EQ(moved.neighbors.size(), as_it_is.neighbors.size());
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

/// Cells as narrow as rounding is at the outline's coordinates are no slivers that rounding left.
TEST(OutlineCells, narrowCellsAreNoSlivers) {
  const auto outline = outlineOf({{{{-1e5, 1}, {3e4, -2e5}, {1e5, 7}, {1e4, 1.3e5}}}});
  const Sites sites{{0, 2e-10, 6e-10, 3e-9}, {1, 1, 1, 1}, {}};
  const auto options = inside(outline, boxOf(outline.points));
  const auto cells = cellsOf(sites, options);
  EXPECT_THAT(promisesOf(check(sites, options, cells)), testing::IsEmpty());
  EXPECT_EQ(cells.report.ok, 4u);
}

Outline movedTo(Outline outline, double size, Point to) {
  for (Point& p : outline.points) p = {to.x + size * p.x, to.y + size * p.y};
  return outline;
}

/// The check allows what doubles leave open: which of two sites is nearer, where coordinates have few steps
/// to the outline, or the outline is far larger than the ways between its edges and places beside it.
TEST(OutlineCells, passTheCheckWhereDoublesAreCoarse) {
  const Outline star = outlineOf({{coast({0.5, 0.5}, 0.4, 12, 0.3, 3)}});
  struct Coarse {
    double size;
    Point at;
  };
  for (const auto& [size, at] :
       {Coarse{1, {0, 0}}, {4e-13, {0.85, 0.7}}, {0.2, {1e11, -3e8}}, {7, {2e9, 0}}}) {
    SCOPED_TRACE(testing::Message() << size << " at " << at.x << ", " << at.y);
    const auto outline = movedTo(star, size, at);
    const auto options = inside(outline, boxOf(outline.points));
    Sites sites{{at.x + 0.5 * size, at.x + 0.3 * size}, {at.y + 0.5 * size, at.y + 0.45 * size}, {}};
    sites.x.push_back(std::nextafter(sites.x[0], 1e300));
    sites.y.push_back(sites.y[0]);
    EXPECT_THAT(promisesOf(check(sites, options, cellsOf(sites, options))), testing::IsEmpty());
  }
}

/// Crosses of four sites whose middle edges are ties: the vertices of whole cells are moved by that, as those
/// of cut ones are.
TEST(OutlineCells, tiesMoveWholeCellsAsTheyDoCutOnes) {
  Sites sites;
  for (int k = 0; k < 64; ++k) {
    const Point middle{0.0625 + 0.125 * (k % 8), 0.0625 + 0.125 * std::floor(k / 8.0)};
    for (const auto& [x, y] : {Point{0.02, 0}, {0, 0.02 * (1 + 9e-7)}, {-0.02, 0}, {0, -0.02 * (1 + 9e-7)}}) {
      sites.x.push_back(middle.x + x);
      sites.y.push_back(middle.y + y);
    }
  }
  const auto options = inside(outlineOf({{coast({0.5, 0.5}, 0.4, 12, 0.3, 3)}}));
  const auto cells = cellsOf(sites, options);
  EXPECT_THAT(promisesOf(check(sites, options, cells)), testing::IsEmpty());
  expectWhole(cells, 4e-8);
}

/// The first cell is a strip, 1e-7 high, of whose right end a tie makes a point.
TEST(OutlineCells, thinnerThanTiesAreMeasuredAsTheyAre) {
  const Sites sites{{0, 0, 1}, {0, 2e-7, 0}, {}};
  const auto strip = [&](const std::vector<std::vector<RingPoints>>& polygons) {
    const auto options = inside(outlineOf(polygons));
    auto cells = cellsOf(sites, options);
    EXPECT_THAT(*check(sites, options, cells), testing::IsEmpty());
    EXPECT_NEAR(areaSum(cells), outlineArea(outlineOf(polygons)), 1e-14);
    EXPECT_EQ(cells.report.ok, 3U);
    return cells;
  };
  const Diagram whole = strip({{rectangle(0, 0, 1, 1)}});
  EXPECT_NEAR(whole.area[0], 5e-8, 1e-20);
  EXPECT_NEAR(whole.centroid[0].x, 0.25, 1e-9);
  EXPECT_NEAR(whole.centroid[0].y, 5e-8, 1e-16);
  EXPECT_NEAR(whole.second_moments[0][0], 1e-7 / 96, 1e-18);
  EXPECT_NEAR(whole.second_moments[0][2], 1e-21 / 24, 1e-32);
  EXPECT_NEAR(whole.area[1], ((1 - 4e-14) * (1 - 1e-7) + 2e-7 * (1 - 1e-14)) / 2, 1e-15);
  EXPECT_NEAR(strip({{rectangle(0.125, 0, 1, 1)}}).area[0], 3.75e-8, 1e-16);
  const Diagram two = strip({{rectangle(0, 0, 1, 1), rectangle(0.25, 2e-8, 0.375, 0.5)}});
  EXPECT_NEAR(two.area[0], 4e-8, 1e-16);
  // Its polygon has nothing inside, but it has.
  const Diagram beside = strip({{rectangle(0.3, 6e-8, 0.8, 1)}});
  EXPECT_NEAR(beside.area[0], 8e-9, 1e-16);
  EXPECT_NEAR(beside.centroid[0].x, 0.4, 1e-9);
  // Of its polygon a part is inside, and ends at the outline where it does not.
  EXPECT_NEAR(strip({{rectangle(0.125, 6e-8, 0.875, 1)}}).area[0], 1.5e-8, 1e-16);
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

TEST(OutlineCells, combsLeaveCellsManyEdgesInCommon) {
  RingPoints comb{{0, 0}, {1, 0}};
  const int dents = 2000;
  for (int k = dents; k > 0; --k) {
    comb.push_back({static_cast<double>(k) / dents, 1});
    comb.push_back({(k - 0.5) / dents, 0.001});
  }
  comb.push_back({0, 1});
  const Outline outline = outlineOf({{comb}});
  const Sites sites{{0.5, 0.5, 0.5}, {0.1, 0.5, 0.9}, {}};
  expectAsGeos(sites, outline);
  const Diagram cells = cellsOf(sites, inside(outline));
  EXPECT_EQ(std::ranges::count(cells.neighbors, 1), 2 * (dents + 1));
}

TEST(OutlineCells, threadsAndDetailDoNotMatter) {
  const Outline outline = country(2000);
  const Sites sites = generate(Pattern::random, 5000, 9);
  CellsOptions options = inside(outline);
  std::vector<Diagram> runs;
  for (const int threads : {1, 3}) {
    runs.push_back(std::move(*cpuSession(threads).cells(sites, options)));
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

/// A corner at -5e-306 is less than zero in no product of doubles: signs do not go together there. The cells
/// are not right; that there are some is what is promised.
TEST(OutlineCells, areMadeWhereSignsOfEdgesThatMeetDoNotGoTogether) {
  const Sites sites = {{0.125, 0.6249999999999999, 0.37500000000000017, 0.8750000000000003,
                        -500.0455002844409, 40223830223.93475, 34592124069.14654},
                       {0.28349364905389046, 0.28349364905389046, 0.7165063509461094, 0.7165063509461095,
                        -500.0455002844408, -6055853233.95285, -14020435298.683352},
                       {}};
  const Outline outline = {{{0.8750000000000003, -10038144266.3181},
                            {0.8750000000000003, -7010217648.983423},
                            {0.2500000000000001, -7010217648.983423},
                            {0.2500000000000001, -5.2028214472036186e-306},
                            {5.756461633308779e-06, -5.2028214472036186e-306},
                            {5.756461633308779e-06, -10038144266.3181}},
                           {0, 6},
                           {0, 1}};
  EXPECT_EQ(cellsOf(sites, inside(outline, boxOf(outline.points))).status.size(), sites.size());
}

}  // namespace
}  // namespace vorpipe::test
