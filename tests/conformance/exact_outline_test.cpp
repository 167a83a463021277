/// The cells of every backend in outlines, against exact arithmetic: outlines whose sides lie in bisectors,
/// whose corners are vertices of the diagram, with holes on lattices; straight, turned by Pythagorean
/// triples, weighted.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact_fixture.h"
#include "support/devices/backends.h"
#include "support/exact/exact_outline.h"
#include "support/hard/hard_random.h"
#include "support/hard/stepped_outline.h"

/// Names of its own, since sources are compiled together.
namespace vorpipe::test::outlined {
namespace {

constexpr std::uint64_t seed = 20261127;

struct OutlinedScene {
  Sites sites;
  Outline outline;
};

/// In a square from 0, on whole numbers.
Sites wholeSites(std::uint64_t most, double side, Random& random) {
  std::set<std::pair<double, double>> places;
  for (auto n = 2 + random.below(most); n > 0; --n) {
    const auto x = static_cast<double>(random.below(static_cast<std::uint64_t>(side) + 1));
    places.emplace(x, static_cast<double>(random.below(static_cast<std::uint64_t>(side) + 1)));
  }
  Sites sites;
  for (const auto& [x, y] : places) add(sites, {x, y});
  return sites;
}

std::vector<double> evenly(double step, std::size_t count) {
  std::vector<double> all;
  for (std::size_t k = 0; k <= count; ++k) all.push_back(step * static_cast<double>(k));
  return all;
}

/// Sites on whole and half units in rectilinear outlines, where a unit is 2.
OutlinedScene onLattice(Random& random) {
  const std::size_t side = 2 + random.below(6);
  const auto lines = evenly(2, side);
  return {wholeSites(6 * side, 2 * static_cast<double>(side), random), steppedOutline(lines, lines, random)};
}

/// Every site of a lattice, in outlines along its bisectors and through its sites.
OutlinedScene onFullLattice(Random& random) {
  const std::size_t side = 2 + random.below(4);
  OutlinedScene scene{{}, steppedOutline(evenly(1, 2 * side), evenly(1, 2 * side), random)};
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x)
      add(scene.sites, {2.0 * static_cast<double>(x) + 1, 2.0 * static_cast<double>(y) + 1});
  }
  return scene;
}

OutlinedScene withWeights(Random& random) {
  auto scene = onLattice(random);
  for (std::size_t i = 0; i < scene.sites.size(); ++i)
    scene.sites.weight.push_back(static_cast<double>(random.below(9)));
  return scene;
}

/// Rows of a hexagonal lattice, with sides in the upright bisectors of two in a row.
OutlinedScene onHexagons(Random& random) {
  const std::size_t side = 2 + random.below(4);
  OutlinedScene scene{{}, steppedOutline(evenly(1000, 2 * side), evenly(1250, 2 * side), random)};
  for (std::size_t y = 0; y <= 2 * side; ++y) {
    for (std::size_t x = 0; x <= side; ++x)
      add(scene.sites, {1000 * static_cast<double>(2 * x + y % 2), 1732 * static_cast<double>(y)});
  }
  return scene;
}

/// An angle, or a triangle with a hole like it, whose sides have any slope; each site has a twin, mirrored at
/// a side, and some stand in corners.
OutlinedScene withTwins(Random& random) {
  constexpr std::array<Point, 6> ways{{{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 1}, {3, 4}}};
  // Of a quarter of it and less, the squares of the ways leave numbers that doubles hold.
  constexpr double unit = 100;
  const auto whole = [&](std::uint64_t most) { return unit * static_cast<double>(random.below(most)); };
  const Point a{whole(6), whole(6)};
  Point ab = ways[random.below(ways.size())], ac = ways[random.below(ways.size())];
  while (ac.x * ab.y == ac.y * ab.x) ac = ways[random.below(ways.size())];
  const double along = unit * static_cast<double>(2 + random.below(3));
  const double up = unit * static_cast<double>(2 + random.below(3));
  const auto place = [&](double of_ab, double of_ac) {
    return Point{a.x + of_ab * along * ab.x + of_ac * up * ac.x,
                 a.y + of_ab * along * ab.y + of_ac * up * ac.y};
  };
  const bool holed = random.below(2) == 0;
  const Point notch = holed ? place(0.1875, 0.1875) : place(0.25, 0.25);
  OutlinedScene scene{{}, {{a, place(1, 0), place(0, 1)}, {0, 3}, {0, 1}}};
  if (holed) {
    for (const Point p : {notch, place(0.4375, 0.1875), place(0.1875, 0.4375)})
      scene.outline.points.push_back(p);
    scene.outline.ring_offsets.push_back(6);
    scene.outline.polygon_offsets.back() = 2;
  } else {
    // Sides of the notch are parallel to those from the corner.
    scene.outline = {{a, place(1, 0), place(1, 0.25), notch, place(0.25, 1), place(0, 1)}, {0, 6}, {0, 1}};
  }
  std::set<std::pair<double, double>> places;
  for (auto n = 1 + random.below(5); n > 0; --n) {
    const Point p =
        random.below(2) == 0 ? scene.outline.points[random.below(3)] : Point{whole(16), whole(16)};
    const Point on = random.below(3) == 0 ? a : notch, way = random.below(2) == 0 ? ab : ac;
    const Point to{p.x - on.x, p.y - on.y};
    const double twice = 2 * (to.x * way.x + to.y * way.y) / (way.x * way.x + way.y * way.y);
    places.emplace(p.x, p.y);
    places.emplace(on.x + twice * way.x - to.x, on.y + twice * way.y - to.y);
  }
  for (const auto& [x, y] : places) add(scene.sites, {x, y});
  return scene;
}

/// Turned by a right triangle with whole sides, which leaves all numbers whole.
OutlinedScene turned(OutlinedScene scene, Random& random) {
  const auto [c, s] = oneOf(random, {std::pair{3.0, 4.0}, {5.0, 12.0}, {15.0, 8.0}});
  const auto turn = [c = c, s = s](double& x, double& y) {
    const double along = x;
    x = c * along - s * y;
    y = s * along + c * y;
  };
  for (std::size_t i = 0; i < scene.sites.size(); ++i) turn(scene.sites.x[i], scene.sites.y[i]);
  for (Point& p : scene.outline.points) turn(p.x, p.y);
  for (double& weight : scene.sites.weight) weight *= c * c + s * s;
  return scene;
}

struct Kind {
  const char* name;
  OutlinedScene (*make)(Random& random);
};

constexpr std::array<Kind, 5> kinds{{{"lattice", onLattice},
                                     {"fullLattice", onFullLattice},
                                     {"weights", withWeights},
                                     {"hexagons", onHexagons},
                                     {"twins", withTwins}}};

/// With its exact cells, made once for all backends.
struct JudgedScene {
  OutlinedScene scene;
  std::vector<ClippedCell> exact;
};

const std::vector<JudgedScene>& judgedScenes(const Kind& kind) {
  constexpr std::size_t scenes = 24;
  static std::map<std::string, std::vector<JudgedScene>> known;
  auto& all = known[kind.name];
  if (!all.empty()) return all;
  Random random(seed);
  for (std::size_t k = 0; k < scenes; ++k) {
    auto scene = kind.make(random);
    if (k % 2 != 0) scene = turned(std::move(scene), random);
    auto exact = clippedCells(scene.sites, scene.outline);
    all.push_back({std::move(scene), std::move(exact)});
  }
  return all;
}

class AgainstExactOutlines : public testing::TestWithParam<std::tuple<const char*, Kind>>,
                             protected OnBackend {
 protected:
  void SetUp() override { SKIP_UNUSABLE(std::get<0>(GetParam())); }
};

TEST_P(AgainstExactOutlines, agree) {
  const auto& [backend, kind] = GetParam();
  const auto& scenes = judgedScenes(kind);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "scene " << k << " of " << kind.name << ", seed " << seed);
    const auto& [scene, exact] = scenes[k];
    CellsOptions options = cellsOptions(boxOf(scene.outline.points));
    options.outline = scene.outline;
    const auto diagram = session(backend).cells(scene.sites, options);
    ASSERT_TRUE(diagram) << diagram.error().message;
    for (const auto& line : compareClipped(*diagram, exact)) ADD_FAILURE() << line;
    const auto broken = check(scene.sites, options, *diagram);
    ASSERT_TRUE(broken) << broken.error().message;
    for (const auto& line : *broken) ADD_FAILURE() << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, AgainstExactOutlines,
                         testing::Combine(testing::ValuesIn(backend_names), testing::ValuesIn(kinds)),
                         [](const auto& instance) {
                           return testName(std::get<0>(instance.param)) + "_" +
                                  std::get<1>(instance.param).name;
                         });

/// Where the cells are known.
struct Known {
  const char* name;
  Sites sites;
  Outline outline;
  std::vector<double> perimeters;
  std::vector<std::size_t> parts;
  double shared;  ///< by the first two sites
  double area;    ///< of all
};

TEST(ExactOutlines, ofAFewShapesAreKnown) {
  const Outline bent{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {0, 6}, {0, 1}};
  const Outline open{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}}, {0, 8}, {0, 1}};
  const Outline wide{{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, {0, 6}, {0, 1}};
  const Outline holed{
      {{0, 0}, {10, 0}, {10, 12}, {0, 12}, {5, 4.5}, {6, 4.5}, {6, 7.5}, {5, 7.5}}, {0, 4, 8}, {0, 2}};
  const double across = std::sqrt(8);
  const std::vector<Known> all{
      {"a side in the bisector", {{0.5, 1.5}, {0.5, 0.5}, {}}, bent, {6, 4}, {1, 1}, 1, 3},
      {"a side amid the bisector", {{0.5, 1.5}, {1.5, 1.5}, {}}, open, {8, 12}, {1, 2}, 2, 7},
      {"a corner on the bisector",
       {{1, 3}, {1, 3}, {}},
       wide,
       {8 + 2 * across, 8 + 2 * across},
       {1, 2},
       2 * across,
       12},
      {"a hole beside the bisector", {{3, 7, 5, 5}, {6, 6, 2, 10}, {}}, holed, {}, {1, 1, 1, 1}, 0, 117}};
  for (const Known& known : all) {
    const auto cells = clippedCells(known.sites, known.outline);
    SCOPED_TRACE(known.name);
    for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i].parts, known.parts[i]);
    for (std::size_t i = 0; i < known.perimeters.size(); ++i)
      EXPECT_NEAR(cells[i].perimeter, known.perimeters[i], 1e-12);
    const auto& edges = cells[0].edges;
    const auto shared = std::ranges::find(edges, 1, &ExactEdge::neighbor);
    EXPECT_NEAR(shared != edges.end() ? shared->length : 0, known.shared, 1e-12);
    double area = 0;
    for (const auto& cell : cells) area += cell.area;
    EXPECT_NEAR(area, known.area, 1e-12);
  }
}

}  // namespace
}  // namespace vorpipe::test::outlined
