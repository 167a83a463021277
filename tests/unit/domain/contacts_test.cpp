#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "unit/domain/geos_clip.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

namespace vorpipe::test {
namespace {

/// The lengths of a cell's edges by their neighbor.
std::map<std::int64_t, double> lengthsOf(const Diagram& d, std::size_t i) {
  std::map<std::int64_t, double> lengths;
  for (auto e = d.cell_offsets[i]; e < d.cell_offsets[i + 1]; ++e) {
    lengths[d.neighbors[e]] += d.edge_lengths[e];
  }
  return lengths;
}

double outlineLength(const Outline& outline) {
  double length = 0;
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    const auto ring =
        std::span(outline.points)
            .subspan(outline.ring_offsets[r], outline.ring_offsets[r + 1] - outline.ring_offsets[r]);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[(k + 1) % ring.size()];
      length += std::hypot(b.x - a.x, b.y - a.y);
    }
  }
  return length;
}

/// Cells are valid polygons with the areas and perimeters of their records, both cells of an edge have it,
/// and what no two cells have in common is the outline, once.
Diagram rightCells(const Sites& sites, const Outline& outline) {
  const Diagram d = cellsOf(sites, inside(outline, boxOf(outline.points)));
  const double size = outlineLength(outline);
  std::set<std::array<double, 6>> sides;
  double along_outline = 0;
  for (std::size_t i = 0; i < d.status.size(); ++i) {
    EXPECT_EQ(whyInvalid(d, i), "") << "site " << i;
    double area = 0, perimeter = 0;
    const auto bounds = ringBounds(d, i);
    for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
      area += ringArea(std::span(d.vertices).subspan(bounds[r], bounds[r + 1] - bounds[r]));
      for (auto e = bounds[r]; e < bounds[r + 1]; ++e) {
        const Point a = d.vertices[e], b = d.vertices[e + 1 < bounds[r + 1] ? e + 1 : bounds[r]];
        perimeter += d.edge_lengths[e];
        if (d.neighbors[e] < 0) along_outline += d.edge_lengths[e];
        if (d.neighbors[e] < 0) continue;
        sides.insert({a.x, a.y, b.x, b.y, static_cast<double>(i), static_cast<double>(d.neighbors[e])});
      }
    }
    EXPECT_NEAR(area, d.area[i], 1e-12 * size * size) << "site " << i;
    EXPECT_NEAR(perimeter, d.perimeter[i], 1e-12 * size) << "site " << i;
  }
  EXPECT_NEAR(along_outline, size, 1e-12 * size);
  for (const auto& [ax, ay, bx, by, site, neighbor] : sides) {
    EXPECT_TRUE(sides.contains({bx, by, ax, ay, neighbor, site})) << site << " and " << neighbor;
  }
  return d;
}

/// A turn by an angle with a cosine of u / sqrt(u^2 + v^2), and a growth that keeps whole numbers whole.
struct Turn {
  double u, v;
  [[nodiscard]] double growth() const { return std::hypot(u, v); }
  [[nodiscard]] Point operator()(Point p) const { return {u * p.x - v * p.y, v * p.x + u * p.y}; }
  [[nodiscard]] Sites operator()(Sites sites) const {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const Point p = (*this)(Point{sites.x[i], sites.y[i]});
      sites.x[i] = p.x, sites.y[i] = p.y;
    }
    for (double& w : sites.weight) w *= u * u + v * v;
    return sites;
  }
  [[nodiscard]] Outline operator()(Outline outline) const {
    for (Point& p : outline.points) p = (*this)(p);
    return outline;
  }
};

constexpr std::array<Turn, 5> turns{{{1, 0}, {0, 1}, {3, 4}, {1, 2}, {-7, 5}}};

/// Runs a test for the same scene in several directions: bisectors along the axes, and oblique ones, whose
/// vertices doubles do not hold.
template <class Test>
void inAllDirections(const Sites& sites, const Outline& outline, const Test& test) {
  for (const Turn& turn : turns) {
    SCOPED_TRACE(testing::Message() << "turned to " << turn.u << ", " << turn.v);
    test(rightCells(turn(sites), turn(outline)), turn.growth());
  }
}

void expectPerimeters(const Diagram& d, double unit, const std::vector<double>& perimeters) {
  for (std::size_t i = 0; i < perimeters.size(); ++i) {
    EXPECT_NEAR(d.perimeter[i], unit * perimeters[i], 1e-13 * unit * perimeters[i]) << "site " << i;
  }
}

TEST(OutlineContacts, aSideOnABisectorIsTheOutlines) {
  const Outline corner = outlineOf({{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}});
  inAllDirections({{0.5, 1.5}, {0.5, 0.5}, {}}, corner, [](const Diagram& d, double unit) {
    expectPerimeters(d, unit, {6, 4});
    EXPECT_NEAR(lengthsOf(d, 0)[1], unit, 1e-14 * unit);
    EXPECT_NEAR(lengthsOf(d, 1)[0], unit, 1e-14 * unit);
  });
}

TEST(OutlineContacts, whatNoWidthJoinsAreParts) {
  const Outline fork = outlineOf({{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}}}});
  inAllDirections({{0.5, 1.5}, {1.5, 1.5}, {}}, fork, [](const Diagram& d, double unit) {
    expectPerimeters(d, unit, {8, 12});
    EXPECT_EQ(ringBounds(d, 1).size(), 3U);
    EXPECT_EQ(std::ranges::count(d.neighbors, 0), 2);
    EXPECT_NEAR(lengthsOf(d, 1)[0], 2 * unit, 1e-14 * unit);
  });
}

TEST(OutlineContacts, cellsThatMeetAtTheEndsOfAHoleAreNoNeighbors) {
  const Outline wall = outlineOf({{rectangle(0, 0, 10, 12), rectangle(5, 4.5, 6, 7.5)}});
  inAllDirections({{3, 7, 5, 5}, {6, 6, 2, 10}, {}}, wall, [](const Diagram& d, double unit) {
    EXPECT_FALSE(lengthsOf(d, 0).contains(1));
    EXPECT_FALSE(lengthsOf(d, 1).contains(0));
    EXPECT_NEAR(d.perimeter[1] / unit, 24.18, 0.005);
  });
}

TEST(OutlineContacts, aReflexCornerOnABisectorMakesTwoParts) {
  const Outline corner = outlineOf({{{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}}});
  inAllDirections({{1, 3}, {1, 3}, {}}, corner, [](const Diagram& d, double unit) {
    EXPECT_EQ(ringBounds(d, 0).size(), 2U);
    EXPECT_EQ(ringBounds(d, 1).size(), 3U);
    expectPerimeters(d, unit, {8 + 4 * std::sqrt(2.0), 8 + 4 * std::sqrt(2.0)});
  });
}

TEST(OutlineContacts, aHoleMayTouchABisectorInACorner) {
  // From the left at (4, 4), where the bisector is cut in two.
  const Outline pierced = outlineOf({{rectangle(0, 0, 8, 8), {{4, 4}, {3, 5}, {2, 4}, {3, 3}}}});
  inAllDirections({{1, 7}, {4, 4}, {}}, pierced, [](const Diagram& d, double unit) {
    EXPECT_EQ(ringBounds(d, 0).size(), 3U);
    EXPECT_EQ(ringBounds(d, 1).size(), 2U);
    EXPECT_EQ(std::ranges::count(d.neighbors, 0), 2);
    expectPerimeters(d, unit, {24 + 4 * std::sqrt(2.0), 24});
  });
}

TEST(OutlineContacts, ringsThatTouchMakeNoRingThatTouchesItself) {
  // A corner of the hole lies in the middle of a side, and two lie on the bisector, which leave the lower
  // cell two parts.
  const Outline touching = outlineOf({{rectangle(0, 0, 8, 8), {{4, 0}, {6, 4}, {4, 7}, {1, 4}}}});
  inAllDirections({{2, 2}, {2, 6}, {}}, touching, [](const Diagram& d, double unit) {
    EXPECT_EQ(ringBounds(d, 0).size(), 3U);
    EXPECT_EQ(ringBounds(d, 1).size(), 2U);
    EXPECT_NEAR(lengthsOf(d, 0)[1], 3 * unit, 1e-14 * unit);
  });
}

TEST(OutlineContacts, sidesAlongBisectorsByWeight) {
  // Powers are equal at x = 3.
  const Outline fork = outlineOf({{{{0, 0}, {8, 0}, {8, 2}, {3, 2}, {3, 4}, {8, 4}, {8, 6}, {0, 6}}}});
  inAllDirections({{1, 4}, {3, 3}, {4, 1}}, fork, [](const Diagram& d, double unit) {
    expectPerimeters(d, unit, {18, 28});
    EXPECT_EQ(ringBounds(d, 1).size(), 3U);
  });
}

TEST(OutlineContacts, cornersMayBeVerticesOfTheDiagram) {
  // Sides go on through other vertices, and so do those of the hole.
  Sites lattice;
  for (int k = 0; k < 64; ++k) {
    lattice.x.push_back(k % 8 - 1.5);
    lattice.y.push_back(k / 8 - 1.5);
  }
  const Outline diamond = outlineOf({{{{2, 0}, {4, 2}, {2, 4}, {0, 2}}, {{2, 1}, {1, 2}, {2, 3}, {3, 2}}}});
  inAllDirections(lattice, diamond, [](const Diagram& d, double) { EXPECT_EQ(d.report.ok, 12U); });
}

/// The last cell is narrower than ties: one edge with each of the others, and no width.
TEST(OutlineContacts, aCellWithoutWidthStaysBetweenItsNeighbors) {
  const Sites sites{{0.6822196843652429, 0.28530892237026456, 0.6309501123479289},
                    {0.8405956736205962, 0.09871046610385265, 0.7447652232589582},
                    {0.24597633515414558, 0.12115750519812743, 0.15022070118926067}};
  const RingPoints box =
      rectangle(-4.378220163210653, -3.2093247974687023, 5.607401876818541, 4.637699483769552);
  const auto options = inside(outlineOf({{box}}), boxOf(box));
  const Diagram d = cellsOf(sites, options);
  EXPECT_THAT(*check(sites, options, d), testing::IsEmpty());
  const double length = lengthsOf(d, 0)[2];
  EXPECT_NEAR(length, 5.61, 0.01);
  EXPECT_EQ(lengthsOf(d, 2), (std::map<std::int64_t, double>{{0, length}, {1, length}}));
  EXPECT_EQ(lengthsOf(d, 1)[2], length);
}

TEST(OutlineContacts, cornersNearerThanTheirSideShowsKeepTheirOrder) {
  for (const double tiny : {1e-20, 1e-60, 1e-200}) {
    const Outline outline = outlineOf({{{{0, 0}, {1, 0}, {1, 1}, {tiny, 1}, {tiny / 100, 1}, {0, 1}}}});
    const auto options = inside(outline, {0, 0, 1, 1});
    const Sites site{{0.5}, {0.5}, {}};
    const Diagram d = cellsOf(site, options);
    EXPECT_THAT(*check(site, options, d), testing::IsEmpty()) << tiny;
    const auto at = std::ranges::find(d.vertices, Point{tiny, 1}) - d.vertices.begin();
    ASSERT_LT(static_cast<std::size_t>(at) + 1, d.vertices.size()) << tiny;
    EXPECT_EQ(d.vertices[static_cast<std::size_t>(at) + 1], (Point{tiny / 100, 1})) << tiny;
  }
}

/// The tip of the second cell, 2e-9 wide, crosses itself after ties. It is no hole.
TEST(OutlineContacts, aCellWithATipThatTiesTurnAroundIsThere) {
  const Sites sites{{0.11056996679643934, 0.11047353040022681, 0.11067536060935518, 0.11055270966730217,
                     0.1106243525689229, 0.11046526881090962, 0.6288865270161137, 0.627059321708436},
                    {0.15293900231134808, 0.15293893973623066, 0.15293915052794418, 0.15293898598571692,
                     0.1529390683838752, 0.15293893762160332, 0.891980808440052, 0.8915295397781926},
                    {0.11403435585575507, 0.11408435126671086, 0.11397970334208818, 0.11404330330512957,
                     0.11400615556563615, 0.11408863377143337, 0.34011809760445666, 0.3387026122432226}};
  const auto options = inside(outlineOf({{rectangle(0, 0, 1, 1)}}), {0, 0, 1, 1});
  const Diagram d = cellsOf(sites, options);
  EXPECT_THAT(*check(sites, options, d), testing::IsEmpty());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(d.perimeter[i] > 0, d.area[i] > 1e-20) << "site " << i;
  }
}

/// A country of boxes whose corners are whole numbers, and sites at halves of them: their bisectors run along
/// its sides and through its corners.
TEST(OutlineContacts, boxesOverALatticeAreDividedAsExactNumbersSay) {
  for (unsigned seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const auto upTo = [&](unsigned n) { return static_cast<double>(random() % (n + 1)); };
    std::vector<std::vector<RingPoints>> boxes;
    for (unsigned k = 0; k < 2 + seed % 5; ++k) {
      const double x = upTo(6), y = upTo(6);
      boxes.push_back({rectangle(x, y, x + 1 + upTo(3), y + 1 + upTo(3))});
    }
    const auto country = mended(outlineOf(boxes), /*repair=*/false);
    ASSERT_TRUE(country) << country.error().message;
    std::set<std::pair<double, double>> places;
    while (places.size() < 3 + seed % 8) places.emplace(upTo(20) / 2, upTo(20) / 2);
    Sites sites;
    for (const auto& [x, y] : places) sites.x.push_back(x), sites.y.push_back(y);
    const Turn& turn = turns[seed % turns.size()];
    rightCells(turn(sites), turn(country->outline));
  }
}

/// In decimals, corners that lie on bisectors lie beside them by less than doubles show of what is rounded.
struct Decimals {
  Sites sites;
  RingPoints ring;
};

const std::vector<Decimals>& decimals() {
  static const std::vector<Decimals> all{
      {{{0.4, 0.8}, {1.4, 1.2}, {}},
       {{-0.8, 0}, {0.4, -0.6}, {1.1, 0.3}, {0.4, 0.9}, {1.4, 0.9}, {0.4, 2.4}}},
      {{{0.3, 0.7}, {0.9, 0.7}, {}},
       {{-0.9, -0.5}, {0.3, -1.1}, {1, -0.2}, {0.3, 0.4}, {1.3, 0.4}, {0.3, 1.9}}},
      {{{0.4, 0.5, 0.6}, {0.6, 0.3, 0.8}, {}}, {{0.5, 0.5}, {0.6, 0.5}, {0.6, 0.6}, {0.7, 0}}},
      {{{-0.04, 0.01, 0.08, -0.02, -0.11, 0.18, 0.22, 0.03},
        {0.23, 0.2, 0.1, 0.1, 0.3, 0.09, 0.09, 0.21},
        {}},
       {{-0.03, 0.19}, {0.03, 0.1}, {0.21, 0.06}, {0.2, 0.07}, {0.24, 0.12}, {-0.04, 0.23}}}};
  return all;
}

TEST(OutlineContacts, cornersThatRoundingPutsBesideABisectorLeaveSimpleParts) {
  for (const auto& [sites, ring] : decimals()) {
    const Outline outline = outlineOf({{ring}});
    const auto options = inside(outline, boxOf(outline.points));
    EXPECT_THAT(*check(sites, options, rightCells(sites, outline)), testing::IsEmpty());
  }
}

TEST(OutlineContacts, aSideBesideABisectorByRoundingIsNoStrip) {
  // The side from (3/7, 12/7) to (0, 15/7) lies on the bisector, in sevenths; exact signs say that the domain
  // ends before it.
  const auto sevenths = [](RingPoints points) {
    for (Point& p : points) p = {p.x * 3 / 7, p.y * 3 / 7};
    return points;
  };
  const Sites sites{{0.42857142857142855, 1.2857142857142858}, {0.8571428571428571, 1.7142857142857142}, {}};
  const Outline outline = outlineOf({{sevenths({{11, -10}, {16, 23}, {1, 17}, {1, 4}, {0, 5}, {-5, 0}})}});
  const Diagram d = rightCells(sites, outline);
  EXPECT_NEAR(lengthsOf(d, 0)[1], 6.379910807698174, 1e-12);
  EXPECT_NEAR(d.perimeter[1], 31.673683344423146, 1e-12);
}

TEST(OutlineContacts, aHoleThatTouchesItsPartInTwoCornersIsLeftOut) {
  const Sites sites{{2.25, 0.5, 1.75, 4.5, 0.25}, {4.5, 1.75, 0.5, 4, 1.25}, {}};
  const Outline outline = outlineOf({{{{0, 1},
                                       {0, 2},
                                       {1, 2},
                                       {1, 3},
                                       {3, 3},
                                       {3, 4},
                                       {0, 4},
                                       {0, 5},
                                       {5, 5},
                                       {5, 0},
                                       {2, 0},
                                       {2, 1},
                                       {1, 1},
                                       {1, 0},
                                       {0, 0}},
                                      {{3, 1}, {3, 2}, {2, 2}, {2, 1}}}});
  EXPECT_NEAR(rightCells(sites, outline).perimeter[2], 17.124875436495142, 1e-12);
}

/// The bisector of the last two is a side of the outline, less than a tie below the upper wall, to which ties
/// joined its end.
TEST(OutlineContacts, aVertexThatTiesJoinedToAWallLeavesIt) {
  const double low = 0.30000000011929173, side = 0.3000000002502281, high = 0.30000000066588545;
  const double left = 0.6733676085297409, right = 1.0422360574803051;
  const Sites sites{{0.9924529662136592, right, right}, {0.29999999951549333, low, 0.3000000003811645}, {}};
  const Outline outline =
      outlineOf({{rectangle(left, 0.25, right, low)}, {rectangle(left, side, right, high)}});
  const auto options = inside(outline, boxOf(outline.points));
  const Diagram d = cellsOf(sites, options);
  EXPECT_THAT(*check(sites, options, d), testing::IsEmpty());
  EXPECT_FALSE(lengthsOf(d, 1).contains(2));
  EXPECT_NEAR(d.perimeter[1], 2 * (0.024891545 + 0.05), 1e-8);
}

}  // namespace
}  // namespace vorpipe::test
