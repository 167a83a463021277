#include "globe/globe_places.h"

#include <algorithm>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "base/inside.h"
#include "base/try.h"
#include "domain/degrees.h"
#include "domain/edge_tree.h"
#include "globe/chart.h"
#include "globe/direction.h"
#include "sites/weights.h"

namespace vorpipe::core {
namespace {

/// What nanoflann knows of the sites: their vectors and a fourth coordinate. Of all places x of the sphere
/// the squared distance to a site with vector v is 1 - 2 x . v + |v|^2 + h^2, and h makes the last two the
/// same for all sites.
struct GlobeTreePoints {
  std::vector<Direction> vector;
  std::vector<double> height;  ///< empty without weights: all are 0

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return vector.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t k, std::size_t axis) const {
    const Direction& v = vector[k];
    return axis == 0 ? v.x : axis == 1 ? v.y : axis == 2 ? v.z : height.empty() ? 0 : height[k];
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using GlobeTree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, GlobeTreePoints, double, std::uint32_t>, GlobeTreePoints, -1,
    std::uint32_t>;

/// A result set of nanoflann: the first of the points that are nearest up to rounding.
class FirstNearest {
 public:
  using DistanceType = double;

  FirstNearest(const GlobeTreePoints& points, const Direction& place) : points_(points), place_(place) {}

  [[nodiscard]] double worstDist() const { return bound_; }
  [[nodiscard]] bool full() const { return nearest_ != no_site; }
  bool addPoint(double squared, std::uint32_t point) {
    if (squared >= bound_) return true;
    if (nearest_ == no_site || isBetter(point)) nearest_ = point;
    bound_ = std::min(bound_, squared + rounding * std::max(squared, rounding));
    return true;
  }
  void sort() {}  // newer nanoflann calls it

  [[nodiscard]] std::uint32_t nearest() const { return nearest_; }

 private:
  static constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();

  /// A difference of vectors tells which is nearer with more digits than distances do.
  [[nodiscard]] bool isBetter(std::uint32_t point) const {
    const double nearer = dot(place_, points_.vector[point] - points_.vector[nearest_]);
    return nearer > 0 || (nearer == 0 && point < nearest_);
  }

  const GlobeTreePoints& points_;
  Direction place_;
  std::uint32_t nearest_ = no_site;
  double bound_ = std::numeric_limits<double>::infinity();
};

/// Polygons of an outline in the plane where cells are cut by them.
struct InChart {
  InChart(const Chart& of, Rings from) : chart(of), rings(std::move(from)), index(rings) {}

  [[nodiscard]] bool contains(const Direction& place) const {
    if (!chart.isNear(place)) return false;
    const Point at = chart.toPlane(place);
    return index.contains(at) || index.isOnEdge(at);
  }

  Chart chart;
  Rings rings;
  OutlineIndex index;
};

}  // namespace

struct GlobePlaces::State {
  explicit State(const Sites& sites) : points(pointsOf(sites)), tree(4, points, {16}) { tree.buildIndex(); }

  static GlobeTreePoints pointsOf(const Sites& sites) {
    GlobeTreePoints points;
    points.vector.reserve(sites.size());
    const bool has_weights = hasWeights(sites);
    std::vector<double> squared;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      points.vector.push_back(has_weights ? vectorOf(sites, i) : directionOf({sites.x[i], sites.y[i]}));
      if (has_weights) squared.push_back(dot(points.vector[i], points.vector[i]));
    }
    if (!has_weights) return points;
    const double longest = *std::ranges::max_element(squared);
    for (const double length : squared) points.height.push_back(std::sqrt(longest - length));
    return points;
  }

  [[nodiscard]] bool contains(const Direction& place) const {
    return inside.empty() ||
           std::ranges::any_of(inside, [&](const auto& part) { return part->contains(place); });
  }

  GlobeTreePoints points;
  GlobeTree tree;
  std::vector<std::unique_ptr<InChart>> inside;  ///< empty without an outline
};

Result<GlobePlaces> GlobePlaces::make(const Sites& sites, const Outline& outline) {
  GlobePlaces places;
  places.state_ = std::make_unique<State>(sites);
  if (outline.empty()) return places;
  VORPIPE_LET(charts, chartsOf(outline));
  for (const ChartedOutline& charted : charts) {
    const Chart chart(charted.center);
    VORPIPE_LET(plane, outlineIn(chart, charted));
    VORPIPE_VAR(rings, ringsOf(plane, 0));
    places.state_->inside.push_back(std::make_unique<InChart>(chart, std::move(rings)));
  }
  return places;
}

GlobePlaces::GlobePlaces() = default;
GlobePlaces::GlobePlaces(GlobePlaces&&) noexcept = default;
GlobePlaces::~GlobePlaces() = default;

std::uint32_t GlobePlaces::at(Point degrees) const {
  if (!std::isfinite(degrees.x) || !(std::abs(degrees.y) <= quarter_turn)) return no_site;
  const Direction place = directionOf(degrees);
  if (!state_->contains(place)) return no_site;
  const std::array<double, 4> query{place.x, place.y, place.z, 0};
  FirstNearest found(state_->points, place);
  state_->tree.findNeighbors(found, query.data(), {});
  return found.nearest();
}

}  // namespace vorpipe::core
