#include "backend/cpu/nearest_site.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "backend/cpu/double_double.h"
#include "base/parallel.h"

namespace vorpipe::cpu {
namespace {

/// Some of the sites that may have cells, except heavy ones, as points. With weights, the points lie above
/// the plane: the square of a site's height is how much lighter it is than the heaviest of them. Distances
/// then rank like powers.
template <std::size_t Dimensions>
class Cloud {
 public:
  Cloud(const SiteSet& sites, Point base, std::vector<std::uint32_t> site, double heaviest)
      : sites_(sites), base_(base), site_(std::move(site)) {
    if (Dimensions == 3)
      for (const auto i : site_) height_.push_back(std::sqrt(heaviest - sites.weight[i]));
    for (std::size_t axis = 0; axis < Dimensions; ++axis) {
      for (std::uint32_t point = 0; point < site_.size(); ++point) {
        const double at = kdtree_get_pt(point, axis);
        box_[axis] = {std::min(box_[axis].low, at), std::max(box_[axis].high, at)};
      }
    }
  }

  /// The least and the largest coordinate of all points.
  struct Span {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] const Span& along(std::size_t axis) const { return box_[axis]; }

  [[nodiscard]] std::uint32_t siteOf(std::uint32_t point) const { return site_[point]; }

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return site_.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t point, std::size_t axis) const {
    if (axis == 2) return height_[point];
    return axis == 0 ? sites_.x[site_[point]] - base_.x : sites_.y[site_[point]] - base_.y;
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds& bounds) const {
    for (std::size_t axis = 0; axis < Dimensions; ++axis) {
      bounds[axis].low = box_[axis].low;
      bounds[axis].high = box_[axis].high;
    }
    return true;
  }

 private:
  const SiteSet& sites_;
  Point base_;
  std::vector<std::uint32_t> site_;  // by point
  std::vector<double> height_;       // by point
  std::array<Span, Dimensions> box_;
};

/// Squared distances with a smaller relative difference than this may be in either order.
constexpr double near_tie = 1e-14;

double weightOf(const SiteSet& s, std::uint32_t i) { return s.weight.empty() ? 0 : s.weight[i]; }

/// Returns how much larger the power of a place to a is than to b, in twice the precision.
DoubleDouble wideLead(const SiteSet& s, std::uint32_t b, std::uint32_t a, Point base, Point p) {
  const auto towards = [](double at_base, double at, double of_a, double of_b) {
    const DoubleDouble from_a = DoubleDouble::sum(at_base, -of_a) + DoubleDouble(at);
    const DoubleDouble from_b = DoubleDouble::sum(at_base, -of_b) + DoubleDouble(at);
    return (from_a + from_b) * DoubleDouble::sum(of_b, -of_a);
  };
  return towards(base.x, p.x, s.x[a], s.x[b]) + towards(base.y, p.y, s.y[a], s.y[b]) +
         DoubleDouble::sum(weightOf(s, b), -weightOf(s, a));
}

/// Whether a place is nearer to b than to a. Uses differences, never squared distances: far from both, and
/// with weights, large terms may cancel.
bool isNearerTo(const SiteSet& s, std::uint32_t b, std::uint32_t a, Point base, Point p) {
  const double weight_a = weightOf(s, a), weight_b = weightOf(s, b);
  const double x_from_a = (base.x - s.x[a]) + p.x, x_from_b = (base.x - s.x[b]) + p.x;
  const double y_from_a = (base.y - s.y[a]) + p.y, y_from_b = (base.y - s.y[b]) + p.y;
  const double along_x = (x_from_a + x_from_b) * (s.x[b] - s.x[a]);
  const double along_y = (y_from_a + y_from_b) * (s.y[b] - s.y[a]);
  const double lead = (along_x + along_y) + (weight_b - weight_a);
  const double terms = (std::abs(x_from_a) + std::abs(x_from_b)) * std::abs(s.x[b] - s.x[a]) +
                       (std::abs(y_from_a) + std::abs(y_from_b)) * std::abs(s.y[b] - s.y[a]) +
                       std::abs(weight_b) + std::abs(weight_a);
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  if (std::abs(lead) > rounding * terms) return lead > 0;
  return wideLead(s, b, a, base, p).high > 0;
}

/// The result of a search: the nearest site, those that may be as near, and, if wanted, the distance of the
/// second nearest. A result set of nanoflann.
template <std::size_t Dimensions>
class NearestAndTies {
 public:
  using DistanceType = double;

  explicit NearestAndTies(bool wants_second) : wants_second_(wants_second) {}

  /// Sets the cloud of the points that are added next.
  void from(const Cloud<Dimensions>& cloud) { cloud_ = &cloud; }

  /// Distances are squared.
  [[nodiscard]] double worstDist() const { return worst_; }
  [[nodiscard]] bool full() const { return best_.site != no_site; }
  bool addPoint(double squared, std::uint32_t point) {
    if (squared >= worst_) return true;
    Candidate added{squared, cloud_->siteOf(point)};
    if (added < best_) std::swap(added, best_);
    second_ = std::min(second_, added.squared);
    const double tied = best_.squared * (1 + near_tie);
    worst_ = wants_second_ ? std::max(second_, tied) : tied;
    if (added.site != no_site && added.squared < tied) ties_.push_back(added);
    if (!ties_.empty()) std::erase_if(ties_, [&](const Candidate& tie) { return tie.squared >= tied; });
    return true;
  }
  void sort() {}  // newer nanoflann calls it at the end; `nearest` sorts by itself

  /// Returns the radius around p within which the nearest site must be the same. A move changes the distance
  /// to a site, or to its point above the plane, by at most its length.
  [[nodiscard]] double reach(Point p) const {
    if (second_ == infinity) return infinity;
    const double other = std::sqrt(second_);
    constexpr double rounding = 1e-12;
    return (other - std::sqrt(best_.squared)) / 2 - rounding * (other + std::abs(p.x) + std::abs(p.y));
  }

  /// Returns, of all sites that may be nearest, the one that is; of several, the first of the input.
  [[nodiscard]] std::uint32_t nearest(const SiteSet& sites, Point base, Point p) {
    auto best = best_.site;
    std::sort(ties_.begin(), ties_.end());
    for (const auto& [squared, site] : ties_) {
      const bool wins = isNearerTo(sites, site, best, base, p) ||
                        (sites.id[site] < sites.id[best] && !isNearerTo(sites, best, site, base, p));
      if (wins) best = site;
    }
    return best;
  }

 private:
  /// Ordered by distance, then by index in the set, whatever the order of visits.
  struct Candidate {
    double squared;
    std::uint32_t site;
    auto operator<=>(const Candidate&) const = default;
  };

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  const Cloud<Dimensions>* cloud_ = nullptr;
  bool wants_second_;
  Candidate best_{infinity, no_site};
  double worst_ = infinity, second_ = infinity;
  std::vector<Candidate> ties_;
};

/// A tree of nanoflann over consecutive sites of the set, which lie near each other.
template <std::size_t Dimensions>
class PartTree {
 public:
  PartTree(const SiteSet& sites, Point base, std::vector<std::uint32_t> site, double heaviest)
      : cloud_(sites, base, std::move(site), heaviest), index_(Dimensions, cloud_, {leaf_size}) {}

  /// Returns the squared distance from a place to the box of all sites of this part.
  [[nodiscard]] double squaredDistance(const std::array<double, 3>& place) const {
    double squared = 0;
    for (std::size_t axis = 0; axis < Dimensions; ++axis) {
      const auto& along = cloud_.along(axis);
      const double away = std::max({along.low - place[axis], place[axis] - along.high, 0.0});
      squared += away * away;
    }
    return squared;
  }

  void search(const std::array<double, 3>& place, NearestAndTies<Dimensions>& found) const {
    found.from(cloud_);
    index_.findNeighbors(found, place.data(), {});
  }

 private:
  using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud<Dimensions>, double, std::uint32_t>;
  static constexpr std::size_t leaf_size = 16;

  Cloud<Dimensions> cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud<Dimensions>, Dimensions, std::uint32_t> index_;
};

/// Trees over parts of the sites, built in parallel. The parts do not depend on the number of threads.
template <std::size_t Dimensions>
class CloudTree {
 public:
  CloudTree(const SiteSet& sites, Point base, int threads)
      : sites_(sites), base_(base), parts_((sites.size() + part_size - 1) / part_size) {
    const double heaviest = heaviestInTree();
    parallelFor(sites.size(), part_size, threads, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> taken;
      taken.reserve(end - begin);
      for (std::size_t i = begin; i < end; ++i) {
        if (isInTree(i)) taken.push_back(static_cast<std::uint32_t>(i));
      }
      if (taken.empty()) return;
      parts_[begin / part_size] =
          std::make_unique<PartTree<Dimensions>>(sites, base, std::move(taken), heaviest);
    });
    std::erase(parts_, nullptr);
  }

  /// Returns the nearest site, or no_site if there is none. The place is relative to the base. For `reach`
  /// see NearestAndTies.
  [[nodiscard]] std::uint32_t nearest(Point p, double* reach) const {
    const std::array<double, 3> place{p.x, p.y, 0};
    NearestAndTies<Dimensions> found(reach != nullptr);
    // The part whose box is nearest is searched first: most places need no other one.
    std::size_t first = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < parts_.size() && least > 0; ++k) {
      const double squared = parts_[k]->squaredDistance(place);
      if (squared < least) least = squared, first = k;
    }
    if (!parts_.empty()) parts_[first]->search(place, found);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (k != first && parts_[k]->squaredDistance(place) < found.worstDist())
        parts_[k]->search(place, found);
    }
    if (reach != nullptr) *reach = found.reach(p);
    return found.nearest(sites_, base_, p);
  }

 private:
  static constexpr std::size_t part_size = std::size_t{1} << 17;

  [[nodiscard]] bool isInTree(std::size_t i) const {
    if (!sites_.hidden.empty() && sites_.hidden[i] != 0) return false;
    return Dimensions == 2 || std::find(sites_.heavy.begin(), sites_.heavy.end(), i) == sites_.heavy.end();
  }

  [[nodiscard]] double heaviestInTree() const {
    double heaviest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sites_.weight.size(); ++i) {
      if (sites_.weight[i] > heaviest && isInTree(i)) heaviest = sites_.weight[i];
    }
    return heaviest;
  }

  const SiteSet& sites_;
  Point base_;
  std::vector<std::unique_ptr<PartTree<Dimensions>>> parts_;
};

}  // namespace

Point countedFrom(const Box& domain) {
  const auto along = [](double low, double high) {
    const bool exact = std::min(std::abs(low), std::abs(high)) >= 2 * (high - low);
    return exact && (low > 0) == (high > 0) ? low : 0.0;
  };
  return {along(domain.xmin, domain.xmax), along(domain.ymin, domain.ymax)};
}

struct NearestSite::Tree {
  Tree(const SiteSet& set, int threads) : sites(set), base(countedFrom(set.domain)) {
    if (sites.weight.empty()) {
      flat.emplace(sites, base, threads);
    } else {
      lifted.emplace(sites, base, threads);
    }
  }

  const SiteSet& sites;
  Point base;
  std::optional<CloudTree<2>> flat;
  std::optional<CloudTree<3>> lifted;
};

NearestSite::NearestSite(const SiteSet& sites, int threads) : tree_(std::make_unique<Tree>(sites, threads)) {}
NearestSite::~NearestSite() = default;

Point NearestSite::placeOf(Point from, Point p) const {
  const Point base = tree_->base;
  return {(from.x - base.x) + p.x, (from.y - base.y) + p.y};
}

std::uint32_t NearestSite::find(Point place, double* reach) const {
  if (tree_->flat) return tree_->flat->nearest(place, reach);
  const auto& sites = tree_->sites;
  auto best = tree_->lifted->nearest(place, reach);
  // Heavy sites are not in the tree, so its reach ignores the distance to them.
  if (reach != nullptr && !sites.heavy.empty()) *reach = 0;
  for (const auto heavy : sites.heavy) {
    if (!sites.hidden.empty() && sites.hidden[heavy] != 0) continue;
    if (best == no_site || isNearerTo(sites, heavy, best, tree_->base, place)) best = heavy;
  }
  return best;
}

std::uint32_t NearestSite::at(Point from, Point p) const { return find(placeOf(from, p), nullptr); }

std::uint32_t NearestSite::Walk::at(Point from, Point p) {
  const Point place = nearest_.placeOf(from, p);
  const double x = place.x - searched_.x, y = place.y - searched_.y;
  if (x * x + y * y < reach_ * reach_) return site_;
  reach_ = 0;
  searched_ = place;
  if (in_vain_ > 0) {
    --in_vain_;
    return nearest_.find(place, nullptr);
  }
  double reach = 0;
  site_ = nearest_.find(place, &reach);
  reach_ = std::max(reach, 0.0);
  if (reach_ < step_) in_vain_ = 15;
  return site_;
}

}  // namespace vorpipe::cpu
