/// Cells along outlines, by hand: right ones, and each with one promise broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "check/places.h"
#include "unit/fixtures/checked_runs.h"
#include "unit/fixtures/outlines.h"

/// Names of its own, since sources are compiled together.
namespace vorpipe::test::outlined {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

/// Vertices, each with what the edge that begins there belongs to.
struct Corner {
  Point from;
  std::int64_t neighbor;
};
using Ring = std::vector<Corner>;
/// By site, rings.
using Cells = std::vector<std::vector<Ring>>;

/// Adds a ring to the records of the last cell.
void addRing(Diagram& d, const Ring& ring) {
  d.ring_starts.push_back(d.vertices.size());
  const Point o = ring.front().from;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k].from, b = ring[(k + 1) % ring.size()].from;
    d.vertices.push_back(a);
    d.neighbors.push_back(ring[k].neighbor);
    d.edge_lengths.push_back(std::hypot(b.x - a.x, b.y - a.y));
    d.perimeter.back() += d.edge_lengths.back();
    const double area = ((a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x)) / 2;
    d.area.back() += area;
    d.centroid.back().x += area * (o.x + a.x + b.x) / 3;
    d.centroid.back().y += area * (o.y + a.y + b.y) / 3;
  }
}

Diagram diagramOf(const Cells& cells) {
  Diagram d;
  d.cell_offsets.push_back(0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    d.status.push_back(Status::ok);
    d.owner.push_back(static_cast<std::uint32_t>(i));
    d.area.push_back(0);
    d.perimeter.push_back(0);
    d.centroid.push_back({0, 0});
    d.second_moments.push_back({});
    for (const Ring& ring : cells[i]) addRing(d, ring);
    d.centroid.back() = {d.centroid.back().x / d.area.back(), d.centroid.back().y / d.area.back()};
    d.cell_offsets.push_back(d.vertices.size());
  }
  d.report.ok = cells.size();
  return d;
}

struct Scene {
  Sites sites;
  Outline outline;
  Cells right;

  [[nodiscard]] std::vector<std::string> broken(const Diagram& diagram) const {
    CellsOptions options = inside(outline, boxOf(outline.points));
    options.detail = Detail::polygons;
    return promisesOf(check(sites, options, diagram));
  }
  [[nodiscard]] std::vector<std::string> brokenBy(const Cells& cells) const {
    return broken(diagramOf(cells));
  }
  /// After a change to the right cells.
  template <class Change>
  [[nodiscard]] std::vector<std::string> brokenAfter(const Change& change) const {
    Cells cells = right;
    change(cells);
    return brokenBy(cells);
  }
};

/// The bisector goes on as a side of the outline.
Scene bent() {
  return {{{0.5, 1.5}, {0.5, 0.5}, {}},
          outlineOf({{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}}),
          {{{{{0, 0}, -3}, {{1, 0}, 1}, {{1, 1}, -5}, {{1, 2}, -4}, {{0, 2}, -1}}},
           {{{{1, 0}, -3}, {{2, 0}, -2}, {{2, 1}, -5}, {{1, 1}, 0}}}}};
}

/// The bisector is a side of the outline between two parts of a cell.
Scene open() {
  return {{{0.5, 1.5}, {1.5, 1.5}, {}},
          outlineOf({{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}}}}),
          {{{{{0, 0}, -3}, {{1, 0}, 1}, {{1, 1}, -5}, {{1, 2}, 1}, {{1, 3}, -4}, {{0, 3}, -1}}},
           {{{{1, 0}, -3}, {{3, 0}, -2}, {{3, 1}, -5}, {{1, 1}, 0}},
            {{{1, 2}, -5}, {{3, 2}, -2}, {{3, 3}, -4}, {{1, 3}, 0}}}}};
}

/// A side of a hole is all that two sites could have in common.
Scene holed() {
  return {{{3, 7, 5, 5}, {6, 6, 2, 10}, {}},
          outlineOf({{rectangle(0, 0, 10, 12), rectangle(5, 4.5, 6, 7.5)}}),
          {{{{{0, 2}, 2}, {{5, 4.5}, -5}, {{5, 7.5}, 3}, {{0, 10}, -1}}},
           {{{{5, 4.5}, 2}, {{10, 2}, -2}, {{10, 10}, 3}, {{5, 7.5}, -5}, {{6, 7.5}, -5}, {{6, 4.5}, -5}}},
           {{{{0, 0}, -3}, {{10, 0}, -2}, {{10, 2}, 1}, {{5, 4.5}, 0}, {{0, 2}, -1}}},
           {{{{0, 10}, 0}, {{5, 7.5}, 1}, {{10, 10}, -2}, {{10, 12}, -4}, {{0, 12}, -1}}}}};
}

/// A corner of the outline touches the bisector.
Scene cornered() {
  return {{{1, 3}, {1, 3}, {}},
          outlineOf({{{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}}}),
          {{{{{0, 0}, -3}, {{4, 0}, 1}, {{2, 2}, 1}, {{0, 4}, -1}}},
           {{{{2, 2}, 0}, {{4, 0}, -2}, {{4, 2}, -5}}, {{{2, 2}, -5}, {{2, 4}, -4}, {{0, 4}, 0}}}}};
}

/// One site, around a hole with an island.
Scene ringed() {
  const auto rings = [](const RingPoints& points, std::int64_t neighbor) {
    Ring ring;
    for (const Point p : points) ring.push_back({p, neighbor});
    return ring;
  };
  Scene scene{{{2}, {0.5}, {}},
              outlineOf({{rectangle(0, 0, 4, 4), rectangle(1, 1, 3, 3)}, {rectangle(1.5, 1.5, 2.5, 2.5)}}),
              {{{{{0, 0}, -3}, {{4, 0}, -2}, {{4, 4}, -4}, {{0, 4}, -1}}}}};
  scene.right[0].push_back(rings({{1, 1}, {1, 3}, {3, 3}, {3, 1}}, -5));
  scene.right[0].push_back(rings(rectangle(1.5, 1.5, 2.5, 2.5), -5));
  return scene;
}

TEST(OutlinedRings, areRight) {
  for (const Scene& scene : {bent(), open(), holed(), cornered(), ringed()})
    EXPECT_THAT(scene.brokenBy(scene.right), IsEmpty());
}

TEST(OutlinedRings, haveNoSpikeAlongTheOutline) {
  const Scene scene = bent();
  const auto broken = scene.brokenAfter([](Cells& cells) {
    cells[0][0] = {{{0, 0}, -3}, {{1, 0}, 1}, {{1, 2}, -4}, {{0, 2}, -1}};
    cells[1][0] = {{{1, 0}, -3}, {{2, 0}, -2}, {{2, 1}, -5}, {{1, 1}, -5}, {{1, 2}, 0}};
  });
  EXPECT_THAT(broken, ElementsAre("rings", "edges"));
}

TEST(OutlinedRings, haveNoBridgeBetweenParts) {
  const Scene scene = open();
  const auto broken = scene.brokenAfter([](Cells& cells) {
    cells[0][0] = {{{0, 0}, -3}, {{1, 0}, 1}, {{1, 3}, -4}, {{0, 3}, -1}};
    cells[1] = {{{{1, 0}, -3},
                 {{3, 0}, -2},
                 {{3, 1}, -5},
                 {{1, 1}, -5},
                 {{1, 2}, -5},
                 {{3, 2}, -2},
                 {{3, 3}, -4},
                 {{1, 3}, 0}}};
  });
  EXPECT_THAT(broken, ElementsAre("rings", "edges"));
}

TEST(OutlinedRings, doNotTouchThemselves) {
  const Scene scene = cornered();
  const auto broken = scene.brokenAfter([](Cells& cells) {
    cells[1] = {{{{2, 2}, 0}, {{4, 0}, -2}, {{4, 2}, -5}, {{2, 2}, -5}, {{2, 4}, -4}, {{0, 4}, 0}}};
  });
  EXPECT_THAT(broken, ElementsAre("rings"));
}

TEST(OutlinedRings, crossNowhereAlongTheOutlineByLittle) {
  // By less than ties move vertices: but no tie does that to an outline.
  const auto broken = bent().brokenAfter([](Cells& cells) {
    cells[0][0] = {{{0, 0}, -3},   {{1, 0}, 1},           {{1, 1}, -5},          {{1, 2}, -5},
                   {{0.4, 2}, -5}, {{0.6, 2 - 1e-9}, -5}, {{0.5, 2 + 1e-9}, -5}, {{0, 2}, -1}};
  });
  EXPECT_THAT(broken, Contains("rings"));
}

TEST(OutlinedRings, ofAPartMeetInOnePointAtMost) {
  const Scene scene = ringed();
  const auto withHole = [&](const RingPoints& points) {
    return scene.brokenAfter([&](Cells& cells) {
      cells[0].resize(1);
      cells[0].emplace_back();
      for (const Point p : points) cells[0][1].push_back({p, -5});
    });
  };
  EXPECT_THAT(withHole({{1, 2}, {2, 3}, {3, 2}, {2, 1}}), testing::Not(Contains("rings")));
  EXPECT_THAT(withHole({{0, 2}, {2, 3}, {3, 2}, {2, 1}}), testing::Not(Contains("rings")));
  EXPECT_THAT(withHole({{0, 2}, {2, 3}, {4, 2}, {2, 1}}), Contains("rings"));
  EXPECT_THAT(withHole({{-1, 2}, {2, 3}, {3, 2}, {2, 1}}), Contains("rings"));
  EXPECT_THAT(withHole({{0, 1}, {0, 3}, {3, 2}}), Contains("rings"));
  EXPECT_THAT(withHole({{5, 2}, {5.5, 3}, {6, 2}}), Contains("rings"));
}

TEST(OutlinedRings, areInOrder) {
  const Scene scene = ringed();
  EXPECT_THAT(scene.brokenAfter([](Cells& cells) { std::swap(cells[0][0], cells[0][1]); }),
              ElementsAre("rings"));
  EXPECT_THAT(scene.brokenAfter([](Cells& cells) { std::swap(cells[0][1], cells[0][2]); }),
              ElementsAre("rings"));
}

TEST(OutlinedRings, haveTheirMeasures) {
  const Scene scene = open();
  const auto after = [&](const auto& change) {
    Diagram d = diagramOf(scene.right);
    change(d);
    return scene.broken(d);
  };
  EXPECT_THAT(after([](Diagram& d) { d.perimeter[1] += 1e-6; }), ElementsAre("rings"));
  EXPECT_THAT(after([](Diagram& d) { d.edge_lengths[1] *= 1 + 1e-9; }), ElementsAre("rings"));
  EXPECT_THAT(after([](Diagram& d) { d.vertices[1].x = NAN; }), Contains("rings"));
}

TEST(OutlinedRings, haveNoNeighborAlongAHole) {
  const Scene scene = holed();
  const auto one_sided = scene.brokenAfter([](Cells& cells) { cells[0][0][1].neighbor = 1; });
  EXPECT_THAT(one_sided, ElementsAre("neighbors", "edges", "outline"));
  const auto both = scene.brokenAfter([](Cells& cells) {
    cells[0][0][1].neighbor = 1;
    cells[1] = {{{{5, 4.5}, 2}, {{10, 2}, -2}, {{10, 10}, 3}, {{5, 7.5}, 0}},
                {{{5, 4.5}, -5}, {{5, 7.5}, -5}, {{6, 7.5}, -5}, {{6, 4.5}, -5}}};
  });
  EXPECT_THAT(both, ElementsAre("rings", "edges"));
}

TEST(OutlinedRings, haveTheirNeighbors) {
  const Scene scene = bent();
  const auto relabeled = [&](std::int64_t one, std::int64_t other) {
    return scene.brokenAfter([&](Cells& cells) {
      cells[0][0][1].neighbor = one;
      cells[1][0][3].neighbor = other;
    });
  };
  EXPECT_THAT(relabeled(-5, -5), ElementsAre("edges"));
  EXPECT_THAT(relabeled(1, -5), ElementsAre("neighbors", "edges"));
}

TEST(OutlinedRings, coverTheOutline) {
  const Scene scene = bent();
  const auto cut = scene.brokenAfter([](Cells& cells) {
    cells[0][0] = {{{0, 0}, -3}, {{1, 0}, 1}, {{1, 1}, -5}, {{0, 2}, -1}};
  });
  EXPECT_THAT(cut, testing::IsSupersetOf({"areas", "edges", "outline"}));
  const auto without = scene.brokenAfter([](Cells& cells) {
    cells[0][0][1].neighbor = -5;
    cells[1][0] = {{{1.5, 0}, -3}, {{2, 0}, -2}, {{2, 1}, -5}, {{1.5, 1}, 0}};
  });
  EXPECT_THAT(without, testing::IsSupersetOf({"areas", "edges", "outline"}));
  const auto twice = open().brokenAfter([](Cells& cells) { cells[1].push_back(cells[1][0]); });
  EXPECT_THAT(twice, testing::IsSupersetOf({"areas", "rings", "outline"}));
}

TEST(OutlinedRings, mayLeaveOutWhatIsNoWiderThanRounding) {
  // A spike as wide as the least step at its place, and one that is wider.
  for (const auto& [width, broken] : {std::pair{0x1p-53, false}, {0x1p-20, true}}) {
    const Scene scene{
        {{0.5}, {0.5}, {}},
        outlineOf(
            {{{{0, 0}, {1, 0}, {1, 0.5}, {2, 0.5}, {2, 0.5 + width}, {1, 0.5 + width}, {1, 1}, {0, 1}}}}),
        {{{{{0, 0}, -3}, {{1, 0}, -5}, {{1, 1}, -4}, {{0, 1}, -1}}}}};
    EXPECT_EQ(testing::Matches(Contains("outline"))(scene.brokenBy(scene.right)), broken);
  }
}

TEST(OutlinedRings, areWhereTheirSitesAreNearest) {
  Scene scene = open();
  std::swap(scene.right[0], scene.right[1]);
  for (auto& cell : scene.right) {
    for (auto& ring : cell) {
      for (Corner& corner : ring) {
        if (corner.neighbor >= 0) corner.neighbor = 1 - corner.neighbor;
      }
    }
  }
  EXPECT_THAT(scene.brokenBy(scene.right), Contains("nearest sites"));
}

TEST(OutlinedRings, areSeenInADomainThatCutsTheOutline) {
  Scene scene = bent();
  CellsOptions options = inside(scene.outline, {0.25, -1, 1.5, 1.5});
  options.detail = Detail::polygons;
  Cells cells{{{{{0.25, 0}, -5}, {{1, 0}, 1}, {{1, 1}, -5}, {{1, 1.5}, -4}, {{0.25, 1.5}, -1}}},
              {{{{1, 0}, -5}, {{1.5, 0}, -2}, {{1.5, 1}, -5}, {{1, 1}, 0}}}};
  EXPECT_THAT(promisesOf(check(scene.sites, options, diagramOf(cells))), IsEmpty());
  cells[0][0][4].neighbor = -5;
  EXPECT_THAT(promisesOf(check(scene.sites, options, diagramOf(cells))), ElementsAre("edges", "outline"));
}

TEST(BoxTree, findsTheBoxesThatMeetOne) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto someBox = [&] {
    const double x = uniform(random), y = uniform(random), size = uniform(random) * uniform(random);
    return Box{x, y, x + size, y + size * uniform(random)};
  };
  for (const std::size_t count : {0u, 1u, 8u, 9u, 17u, 1000u}) {
    std::vector<Box> boxes(count);
    for (Box& box : boxes) box = someBox();
    const core::checks::BoxTree tree(boxes);
    for (int k = 0; k < 100; ++k) {
      const Box asked = someBox();
      std::vector<std::uint32_t> found, wanted;
      tree.eachMeeting(asked, [&](std::uint32_t box) { found.push_back(box); });
      std::ranges::sort(found);
      for (std::uint32_t b = 0; b < count; ++b) {
        const Box& box = boxes[b];
        if (box.xmin <= asked.xmax && asked.xmin <= box.xmax && box.ymin <= asked.ymax &&
            asked.ymin <= box.ymax)
          wanted.push_back(b);
      }
      EXPECT_EQ(found, wanted);
    }
  }
}

}  // namespace
}  // namespace vorpipe::test::outlined
