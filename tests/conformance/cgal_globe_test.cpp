/// Neighbors on the globe against the convex hull of the sites' vectors by CGAL, with exact predicates.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "globe/direction.h"
#include "support/sites/globe_sites.h"
#include "unit/fixtures/cpu_session.h"

namespace vorpipe::test {
namespace {

using core::Direction;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using ExactPoint = Kernel::Point_3;
using Pair = std::pair<std::size_t, std::size_t>;

/// A site's direction on the unit sphere exactly, within rounding of the one in double: the convex hull of
/// vectors that rounding moves off the sphere would have other edges where sites are near to each other.
ExactPoint onSphere(const Direction& d) {
  const std::array at{d.x, d.y, d.z};
  std::size_t most = 0;
  for (const std::size_t k : {1U, 2U}) most = std::abs(at[k]) > std::abs(at[most]) ? k : most;
  const std::size_t next = (most + 1) % 3, last = (most + 2) % 3;
  // From the plane at right angles to the largest coordinate (stereographic).
  const Number u = at[next] / (1 + std::abs(at[most])), v = at[last] / (1 + std::abs(at[most]));
  const Number squared = u * u + v * v, whole = 1 + squared;
  std::array<Number, 3> exact;
  exact[most] = (at[most] < 0 ? squared - 1 : 1 - squared) / whole;
  exact[next] = 2 * u / whole;
  exact[last] = 2 * v / whole;
  return {exact[0], exact[1], exact[2]};
}

/// Whether sites are taken to be on the sphere exactly: with weights, or of many sites, these vectors are as
/// rounded as those of the program, which moves facets between neighbors that are far from each other by
/// little.
bool areExact(const Sites& sites) {
  constexpr std::size_t many = 10000;
  return sites.weight.empty() && sites.size() < many;
}

/// The vector of a site, as globe.md says: p / cos(r).
ExactPoint vectorAt(const Sites& sites, std::size_t i) {
  const Direction d = core::directionOf({sites.x[i], sites.y[i]});
  if (areExact(sites)) return onSphere(d);
  if (sites.weight.empty()) return {d.x, d.y, d.z};
  constexpr double radius = 6371.0071809;
  const double r = std::sqrt(std::abs(sites.weight[i])) / radius;
  const double longer = sites.weight[i] < 0 ? 1 / std::cosh(r) : 1 / std::cos(r);
  return {longer * d.x, longer * d.y, longer * d.z};
}

double inDouble(const Number& number) { return CGAL::to_double(number); }

Direction difference(const ExactPoint& a, const ExactPoint& b) {
  return {inDouble(a.x() - b.x()), inDouble(a.y() - b.y()), inDouble(a.z() - b.z())};
}

/// The place that three vectors share on the sphere: as seen from the first, and from the middle of the
/// Earth.
struct Facet {
  Direction way, normal;
  bool is_near;
  double rounding;

  Facet(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, bool is_exact) {
    constexpr double few = 16, near = 0.5, epsilon = std::numeric_limits<double>::epsilon();
    const Direction to_b = difference(b, a), to_c = difference(c, a), across = cross(to_b, to_c);
    const double size = lengthOf(across), longest = std::max(lengthOf(to_b), lengthOf(to_c));
    const auto depth = [&a](const ExactPoint& p) {
      return inDouble(a.x() * (a.x() - p.x()) + a.y() * (a.y() - p.y()) + a.z() * (a.z() - p.z()));
    };
    way = 1 / (size * size) * (depth(b) * cross(to_c, across) + depth(c) * cross(across, to_b));
    normal = 1 / size * across;
    const double radius = lengthOf(way);
    is_near = radius < near && dot({inDouble(a.x()), inDouble(a.y()), inDouble(a.z())}, across) > 0;
    rounding =
        few * epsilon * (is_near && is_exact ? 1 + (longest + radius) * longest / size : longest / size);
  }
};

struct HullEdges {
  std::set<Pair> edges, in_doubt;  ///< that cells must have as neighbors, or may
};

/// Sides of the hull whose two facets are seen in one direction, as near as ties are, are none of cells.
HullEdges hullEdges(const Sites& sites, const Diagram& found) {
  constexpr double tie = 1e-6;
  Number::set_relative_precision_of_to_double(1e-13);
  const bool is_exact = areExact(sites);
  std::vector<ExactPoint> points;
  std::map<ExactPoint, std::size_t> index;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    points.push_back(vectorAt(sites, i));
    if (found.owner[i] == i) index.emplace(points.back(), i);
  }
  CGAL::Surface_mesh<ExactPoint> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  HullEdges result;
  for (const auto edge : hull.edges()) {
    const auto half = hull.halfedge(edge), twin = hull.opposite(half);
    const auto &a = hull.point(hull.source(half)), &b = hull.point(hull.target(half));
    const Facet left(a, b, hull.point(hull.target(hull.next(half))), is_exact),
        right(a, hull.point(hull.target(hull.next(twin))), b, is_exact);
    const double length =
        lengthOf(left.is_near && right.is_near ? left.way - right.way : left.normal - right.normal);
    const double shortest = tie * lengthOf(difference(b, a));
    const double doubt = left.rounding + right.rounding + 1e-6 * shortest;
    const Pair pair = std::minmax(index.at(a), index.at(b));
    if (length > shortest + doubt)
      result.edges.insert(pair);
    else if (length > shortest - doubt)
      result.in_doubt.insert(pair);
  }
  return result;
}

std::set<Pair> pairsOf(const Diagram& cells) {
  std::set<Pair> pairs;
  for (const Cell cell : cells) {
    for (const std::int64_t other : cell.neighbors()) {
      pairs.insert(std::minmax(cell.index(), static_cast<std::size_t>(other)));
    }
  }
  return pairs;
}

void expectHull(const Sites& sites, std::string_view name) {
  SCOPED_TRACE(name);
  const auto found = cpuSession().cells(sites, ofGlobe());
  ASSERT_TRUE(found) << found.error().message;
  const HullEdges hull = hullEdges(sites, *found);
  std::set<Pair> pairs = pairsOf(*found);
  for (const Pair& pair : hull.in_doubt) pairs.erase(pair);
  EXPECT_EQ(pairs, hull.edges);
  // Else a test of doubts alone would pass.
  EXPECT_LT(hull.in_doubt.size(), hull.edges.size() / 4 + 1);
}

/// Each site has the two that are beside it on the circle around the middle of all.
void expectCircle(const Sites& sites, std::string_view name) {
  SCOPED_TRACE(name);
  const auto found = cpuSession().cells(sites, ofGlobe());
  ASSERT_TRUE(found) << found.error().message;
  if (sites.size() < 4) return;  // of which hulls have no inside, and other tests
  const auto at = [&](std::size_t i) { return core::directionOf({sites.x[i], sites.y[i]}); };
  Direction axis{0, 0, 0};
  for (std::size_t i = 1; i + 1 < sites.size(); ++i) {
    const Direction turn = cross(at(i) - at(0), at(i + 1) - at(0));
    if (lengthOf(turn) > lengthOf(axis)) axis = turn;
  }
  axis = normalized(axis);
  const Direction right = core::perpendicular(axis), up = cross(axis, right);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < sites.size(); ++i)
    order.emplace_back(std::atan2(dot(up, at(i)), dot(right, at(i))), i);
  std::ranges::sort(order);
  std::set<Pair> pairs;
  for (std::size_t k = 0; k < order.size(); ++k)
    pairs.insert(std::minmax(order[k].second, order[(k + 1) % order.size()].second));
  EXPECT_EQ(pairsOf(*found), pairs);
}

TEST(GlobeAgainstHull, hasItsEdges) {
  for (const GlobeSet& set : hardOnGlobe())
    set.on_circle ? expectCircle(set.sites, set.name) : expectHull(set.sites, set.name);
  expectHull(randomOnGlobe(100000, 20261128), "100,000");
}

TEST(GlobeAgainstHull, hasItsEdgesOfTightClustersAndCircles) {
  for (const GlobeSet& set : tightOnGlobe())
    set.on_circle ? expectCircle(set.sites, set.name) : expectHull(set.sites, set.name);
}

/// Sets whose sites are nearer to each other than the radii of caps have digits.
bool areTooNear(const GlobeSet& set) {
  return set.name == "a millimeter" || set.name == "a meter" || set.name == "at a pole";
}

TEST(GlobeAgainstHull, hasItsEdgesWithWeights) {
  for (const GlobeSet& set : hardOnGlobe()) {
    if (set.on_circle || areTooNear(set)) continue;
    expectHull(capsOf(set.sites, 0, 1e6, 5), set.name + ", caps");
    expectHull(capsOf(set.sites, -1e5, 1e5, 6), set.name + ", some imaginary");
  }
  const Sites sites = randomOnGlobe(500, 12);
  Sites equal = sites;
  equal.weight.assign(sites.size(), 1e6);
  expectHull(equal, "equal weights");
}

}  // namespace
}  // namespace vorpipe::test
