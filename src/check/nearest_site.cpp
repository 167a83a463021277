#include "check/nearest_site.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

namespace vorpipe::core::checks {
namespace {

/// The sites in `index`, lifted if they have weights. For a place in the plane, the squared distance in space
/// is then the power, |p - site|^2 - weight, plus a constant that is the same for all sites.
struct Cloud {
  const CheckedSites& run;
  std::vector<std::uint32_t> index;
  std::vector<double> height;  ///< empty without weights
  std::uint32_t heaviest = 0;  ///< of the run
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return index.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t k, std::size_t axis) const {
    if (axis == 2) return height[k];
    const Point p = run.site(index[k]);
    return axis == 0 ? p.x : p.y;
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud, double, std::uint32_t>;
template <int dimensions>
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, dimensions, std::uint32_t>;
constexpr std::size_t leaf_size = 16;
/// A search that visits this many nodes is long. Only long ones are counted: threads would wait for each
/// other's sums.
constexpr std::uint64_t long_search = 256;

/// The result of a search: the nearest point, and those that double cannot distinguish from it. This is a
/// nanoflann result set, so one descent finds both.
class NearestAndEqual {
 public:
  using DistanceType = double;

  NearestAndEqual() {
    constexpr std::size_t few = 8;
    found_.reserve(few);
  }

  /// nanoflann calls it at each node.
  [[nodiscard]] double worstDist() const {
    ++visited_;
    return bound_;
  }
  [[nodiscard]] bool full() const { return !found_.empty(); }
  bool addPoint(double squared, std::uint32_t point) {
    if (squared >= bound_) return true;
    found_.push_back({squared, point});
    // Points as far as the bound are left out; the least distance is 0 at a site.
    const double bound = squared * (1 + squared_rounding) + std::numeric_limits<double>::min();
    if (bound < bound_) {
      bound_ = bound;
      std::erase_if(found_, [&](const Found& other) { return other.squared >= bound_; });
    }
    return true;
  }
  void sort() {}  // newer nanoflann calls it at the end of each search; few callers need an order

  [[nodiscard]] std::uint64_t visited() const { return visited_; }

  struct Found {
    double squared;
    std::uint32_t point;  ///< of the cloud
    auto operator<=>(const Found&) const = default;
  };

  [[nodiscard]] const std::vector<Found>& found() const { return found_; }
  [[nodiscard]] const std::vector<Found>& nearestFirst() {
    std::ranges::sort(found_);
    return found_;
  }

 private:
  double bound_ = std::numeric_limits<double>::infinity();
  mutable std::uint64_t visited_ = 0;
  std::vector<Found> found_;
};

double square(double a) { return a * a; }

/// The least and the largest power of site i over all query points, with its weight relative to that of
/// site 0.
struct Powers {
  double least, most;
};

Powers powersIn(const CheckedSites& run, std::size_t i) {
  const Point p = run.site(i);
  // Queries in a periodic domain reach one period beyond it.
  const Point low =
      run.moved({run.domain.xmin, run.domain.ymin}, {run.repeats_x ? -1 : 0, run.repeats_y ? -1 : 0});
  const Point high =
      run.moved({run.domain.xmax, run.domain.ymax}, {run.repeats_x ? 1 : 0, run.repeats_y ? 1 : 0});
  const auto away = [](double at, double from, double to) {
    return Powers{std::max({from - at, 0.0, at - to}), std::max(at - from, to - at)};
  };
  const Powers x = away(p.x, low.x, high.x), y = away(p.y, low.y, high.y);
  const double weight = run.weightDifference(i, 0);
  return {square(x.least) + square(y.least) - weight, square(x.most) + square(y.most) - weight};
}

/// Whether another site at the position of site i is no lighter, and is kept.
bool standsWithOwner(const CheckedSites& run, std::span<const std::uint32_t> owner, std::uint32_t i) {
  if (owner.size() != run.size() || owner[i] == i || owner[i] >= run.size()) return false;
  const std::uint32_t other = owner[i];
  return owner[other] == other && run.site(other) == run.site(i) &&
         (!run.weighted || run.weightDifference(other, i) >= 0);
}

/// Lifts the sites that may be nearest to a point of the domain. The others may be so much lighter that
/// heights would lose all digits.
Cloud liftedCloud(const CheckedSites& run, std::span<const std::uint32_t> owner) {
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < run.size(); ++i) bound = std::min(bound, powersIn(run, i).most);
  Cloud cloud{run, {}, {}};
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    if (standsWithOwner(run, owner, i)) continue;
    const Powers powers = powersIn(run, i);
    if (powers.least > bound + 64 * epsilon * (std::abs(bound) + std::abs(powers.least))) continue;
    if (cloud.index.empty() || run.weightDifference(i, cloud.heaviest) > 0) cloud.heaviest = i;
    cloud.index.push_back(i);
  }
  for (const auto i : cloud.index) cloud.height.push_back(std::sqrt(run.weightDifference(cloud.heaviest, i)));
  return cloud;
}

Cloud flatCloud(const CheckedSites& run, std::span<const std::uint32_t> owner) {
  Cloud cloud{run, std::vector<std::uint32_t>(run.size()), {}};
  std::iota(cloud.index.begin(), cloud.index.end(), 0u);
  std::erase_if(cloud.index, [&](std::uint32_t i) { return standsWithOwner(run, owner, i); });
  return cloud;
}

}  // namespace

struct NearestSite::Tree {
  Tree(const CheckedSites& run, std::span<const std::uint32_t> owner)
      : cloud(run.weighted ? liftedCloud(run, owner) : flatCloud(run, owner)) {
    if (run.weighted) {
      lifted = std::make_unique<KdTree<3>>(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
    } else {
      flat = std::make_unique<KdTree<2>>(2, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
    }
  }

  [[nodiscard]] NearestAndEqual search(Point p) const {
    const double place[3] = {p.x, p.y, 0};
    NearestAndEqual near;
    if (flat) {
      flat->findNeighbors(near, place, {});
    } else {
      lifted->findNeighbors(near, place, {});
    }
    if (near.visited() > long_search) visited.fetch_add(near.visited(), std::memory_order_relaxed);
    return near;
  }

  Cloud cloud;
  std::unique_ptr<KdTree<2>> flat;  ///< one of these two
  std::unique_ptr<KdTree<3>> lifted;
  mutable std::atomic<std::uint64_t> visited = 0;
};

NearestSite::NearestSite(const CheckedSites& run, std::span<const std::uint32_t> owner)
    : tree_(std::make_unique<Tree>(run, owner)) {}
NearestSite::NearestSite(NearestSite&&) noexcept = default;
NearestSite::~NearestSite() = default;

std::uint32_t NearestSite::at(Point p) const {
  const NearestAndEqual near = tree_->search(p);
  const auto& index = tree_->cloud.index;
  // NaN is not nearer to any site than to another.
  if (near.found().empty()) return index.front();
  std::uint32_t best = index[std::ranges::min(near.found()).point];
  // For sites near each other the squares are inaccurate; the side of their bisector on which p lies is not.
  const CheckedSites& run = tree_->cloud.run;
  for (const auto& other : near.found()) {
    const std::uint32_t site = index[other.point];
    const Point way = run.way(best, site);
    if (way != Point{0, 0} && beyondBisector(way, run.site(best), run.weightDifference(best, site), p) > 0)
      best = site;
  }
  return best;
}

std::vector<std::uint32_t> NearestSite::allAt(Point p) const {
  NearestAndEqual near = tree_->search(p);
  std::vector<std::uint32_t> sites;
  sites.reserve(near.found().size());
  for (const auto& found : near.nearestFirst()) sites.push_back(tree_->cloud.index[found.point]);
  return sites;
}

std::uint32_t NearestSite::heaviest() const { return tree_->cloud.heaviest; }

std::uint64_t NearestSite::visited() const { return tree_->visited.load(std::memory_order_relaxed); }

}  // namespace vorpipe::core::checks
