/// Neighbors on the globe against the convex hull of the sites' vectors by CGAL, with exact predicates.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "support/sites/globe_sites.h"
#include "unit/fixtures/cpu_session.h"

namespace vorpipe::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vector = Kernel::Vector_3;
using Pair = std::pair<std::size_t, std::size_t>;

/// The vector of a site, as globe.md says: p / cos(r).
Kernel::Point_3 vectorAt(const Sites& sites, std::size_t i) {
  const SpacePoint p = onGlobe(Point{sites.x[i], sites.y[i]});
  double longer = 1;
  if (!sites.weight.empty()) {
    constexpr double radius = 6371.0071809;
    const double r = std::sqrt(std::abs(sites.weight[i])) / radius;
    longer = sites.weight[i] < 0 ? 1 / std::cosh(r) : 1 / std::cos(r);
  }
  return {longer * p.x, longer * p.y, longer * p.z};
}

struct HullEdges {
  std::set<Pair> edges, in_doubt;  ///< that cells must have as neighbors, or may
};

/// Sides of the hull whose two facets are seen in one direction, as near as ties are, are none of cells.
HullEdges hullEdges(const Sites& sites, const Diagram& found) {
  constexpr double tie = 1e-6, few = 64;
  std::vector<Kernel::Point_3> points;
  std::map<Kernel::Point_3, std::size_t> index;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    points.push_back(vectorAt(sites, i));
    if (found.owner[i] == i) index.emplace(points.back(), i);
  }
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  struct Facet {
    Vector center;
    double rounding;
  };
  const auto facetOf = [&](auto half) {
    const auto a = hull.point(hull.source(half)), b = hull.point(hull.target(half)),
               c = hull.point(hull.target(hull.next(half)));
    const Vector across = CGAL::cross_product(b - a, c - a);
    const double size = std::sqrt(across.squared_length());
    const double longest = std::sqrt(std::max((b - a).squared_length(), (c - a).squared_length()));
    return Facet{across / size, few * std::numeric_limits<double>::epsilon() * longest / size};
  };
  HullEdges result;
  for (const auto edge : hull.edges()) {
    const auto half = hull.halfedge(edge);
    const auto a = hull.point(hull.source(half)), b = hull.point(hull.target(half));
    const Facet left = facetOf(half), right = facetOf(hull.opposite(half));
    const double length = std::sqrt((left.center - right.center).squared_length());
    const double shortest = tie * std::sqrt((b - a).squared_length());
    const double doubt = left.rounding + right.rounding + 1e-6 * shortest;
    const Pair pair = std::minmax(index.at(a), index.at(b));
    if (length > shortest + doubt)
      result.edges.insert(pair);
    else if (length > shortest - doubt)
      result.in_doubt.insert(pair);
  }
  return result;
}

void expectHull(const Sites& sites, std::string_view name) {
  SCOPED_TRACE(name);
  const auto found = cpuSession().cells(sites, ofGlobe());
  ASSERT_TRUE(found) << found.error().message;
  const HullEdges hull = hullEdges(sites, *found);
  std::set<Pair> pairs;
  for (const Cell cell : *found) {
    for (const std::int64_t other : cell.neighbors()) {
      const Pair pair = std::minmax(cell.index(), static_cast<std::size_t>(other));
      if (!hull.in_doubt.contains(pair)) pairs.insert(pair);
    }
  }
  EXPECT_EQ(pairs, hull.edges);
}

/// Sets whose sites are so near to each other that rounding moves them off the sphere by more than its
/// curvature: no hull of doubles tells who are neighbors.
bool areTooNear(const GlobeSet& set) {
  return set.name == "a millimeter" || set.name == "a meter" || set.name == "at a pole";
}

TEST(GlobeAgainstHull, hasItsEdges) {
  for (const GlobeSet& set : hardOnGlobe()) {
    if (!set.on_circle && !areTooNear(set)) expectHull(set.sites, set.name);
  }
  expectHull(randomOnGlobe(100000, 20261128), "100,000");
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
