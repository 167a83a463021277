#include "backend/cpu/picture.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "backend/cpu/double_double.h"
#include "base/parallel.h"

namespace vorpipe::cpu {
namespace {

/// The sites that may have cells, but for heavy ones, as points; with weights, as points above the plane: the
/// square of a site's height is by how much it is lighter than the heaviest of them, so that distances rank
/// as powers do.
template <std::size_t Dimensions>
class Cloud {
 public:
  Cloud(const SiteSet& sites, Point base) : sites_(sites), base_(base), site_(sites.size()) {
    std::iota(site_.begin(), site_.end(), 0U);
    if (!sites.hidden.empty()) std::erase_if(site_, [&](auto i) { return sites.hidden[i] != 0; });
    if (Dimensions == 2) return;
    for (const auto heavy : sites.heavy) std::erase(site_, heavy);
    double heaviest = -std::numeric_limits<double>::infinity();
    for (const auto i : site_) heaviest = std::max(heaviest, sites.weight[i]);
    for (const auto i : site_) height_.push_back(std::sqrt(heaviest - sites.weight[i]));
  }

  [[nodiscard]] std::uint32_t siteOf(std::uint32_t point) const { return site_[point]; }

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return site_.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t point, std::size_t axis) const {
    if (axis == 2) return height_[point];
    return axis == 0 ? sites_.x[site_[point]] - base_.x : sites_.y[site_[point]] - base_.y;
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }

 private:
  const SiteSet& sites_;
  Point base_;
  std::vector<std::uint32_t> site_;  // by point
  std::vector<double> height_;       // by point
};

/// Squared distances that differ by less than this part of themselves may be in either order.
constexpr double near_tie = 1e-14;

/// Where sites and places are counted from: the domain's corner, along an axis where no difference to it is
/// rounded, of sites in the domain and beside it.
Point baseOf(const Box& domain) {
  const auto along = [](double low, double high) {
    const bool exact = std::min(std::abs(low), std::abs(high)) >= 2 * (high - low);
    return exact && (low > 0) == (high > 0) ? low : 0.0;
  };
  return {along(domain.xmin, domain.xmax), along(domain.ymin, domain.ymax)};
}

/// By how much the power of a place to a is larger than to b, in twice the precision.
DoubleDouble wideLead(const SiteSet& s, std::uint32_t b, std::uint32_t a, Point base, Point p) {
  const auto towards = [](double at_base, double at, double of_a, double of_b) {
    const DoubleDouble from_a = DoubleDouble::sum(at_base, -of_a) + DoubleDouble(at);
    const DoubleDouble from_b = DoubleDouble::sum(at_base, -of_b) + DoubleDouble(at);
    return (from_a + from_b) * DoubleDouble::sum(of_b, -of_a);
  };
  return towards(base.x, p.x, s.x[a], s.x[b]) + towards(base.y, p.y, s.y[a], s.y[b]) +
         DoubleDouble::sum(s.weight[b], -s.weight[a]);
}

/// Whether a place is nearer to b than to a: from differences, never from squared distances. With weights
/// large terms may cancel.
bool isNearerTo(const SiteSet& s, std::uint32_t b, std::uint32_t a, Point base, Point p) {
  const double x_from_a = (base.x - s.x[a]) + p.x, x_from_b = (base.x - s.x[b]) + p.x;
  const double y_from_a = (base.y - s.y[a]) + p.y, y_from_b = (base.y - s.y[b]) + p.y;
  const double along_x = (x_from_a + x_from_b) * (s.x[b] - s.x[a]);
  const double along_y = (y_from_a + y_from_b) * (s.y[b] - s.y[a]);
  if (s.weight.empty()) return along_x + along_y > 0;
  const double lead = (along_x + along_y) + (s.weight[b] - s.weight[a]);
  const double terms = (std::abs(x_from_a) + std::abs(x_from_b)) * std::abs(s.x[b] - s.x[a]) +
                       (std::abs(y_from_a) + std::abs(y_from_b)) * std::abs(s.y[b] - s.y[a]) +
                       std::abs(s.weight[b]) + std::abs(s.weight[a]);
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  if (std::abs(lead) > rounding * terms) return lead > 0;
  return wideLead(s, b, a, base, p).high > 0;
}

template <std::size_t Dimensions>
class CloudTree {
 public:
  CloudTree(const SiteSet& sites, Point base)
      : sites_(sites), base_(base), cloud_(sites, base), index_(Dimensions, cloud_, {16}) {}

  [[nodiscard]] bool isEmpty() const { return cloud_.kdtree_get_point_count() == 0; }

  /// The place is counted from the base.
  [[nodiscard]] std::uint32_t nearest(Point p) const {
    const std::array<double, 3> point{p.x, p.y, 0};
    std::uint32_t found[2] = {0, 0};
    double squared[2] = {0, 0};
    const auto count = index_.knnSearch(point.data(), 2, found, squared);
    auto best = cloud_.siteOf(found[0]);
    if (count < 2 || squared[1] > squared[0] * (1 + near_tie)) return best;

    std::vector<std::pair<std::uint32_t, double>> tied;
    index_.radiusSearch(point.data(), squared[0] * (1 + near_tie), tied,
                        nanoflann::SearchParams(32, 0, true));
    for (const auto& candidate : tied) {
      const auto site = cloud_.siteOf(candidate.first);
      if (isNearerTo(sites_, site, best, base_, p)) best = site;
    }
    return best;
  }

 private:
  using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud<Dimensions>, double, std::uint32_t>;

  const SiteSet& sites_;
  Point base_;
  Cloud<Dimensions> cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud<Dimensions>, Dimensions, std::uint32_t> index_;
};

}  // namespace

struct NearestSite::Tree {
  explicit Tree(const SiteSet& set) : sites(set), base(baseOf(set.domain)) {
    if (sites.weight.empty()) {
      flat.emplace(sites, base);
    } else {
      lifted.emplace(sites, base);
    }
  }

  const SiteSet& sites;
  Point base;
  std::optional<CloudTree<2>> flat;
  std::optional<CloudTree<3>> lifted;
};

NearestSite::NearestSite(const SiteSet& sites) : tree_(std::make_unique<Tree>(sites)) {}
NearestSite::~NearestSite() = default;

std::uint32_t NearestSite::at(Point from, Point p) const {
  const Point base = tree_->base, place{(from.x - base.x) + p.x, (from.y - base.y) + p.y};
  if (tree_->flat) return tree_->flat->nearest(place);
  const auto& sites = tree_->sites;
  auto best = tree_->lifted->isEmpty() ? no_site : tree_->lifted->nearest(place);
  for (const auto heavy : sites.heavy) {
    if (!sites.hidden.empty() && sites.hidden[heavy] != 0) continue;
    if (best == no_site || isNearerTo(sites, heavy, best, base, place)) best = heavy;
  }
  return best;
}

namespace {

/// Of the pixels of a view, seen from its corner.
class Centers {
 public:
  explicit Centers(const View& view)
      : view_(view),
        width_(view.box.xmax - view.box.xmin),
        height_(view.box.ymax - view.box.ymin),
        columns_(static_cast<std::size_t>(view.width)) {}

  [[nodiscard]] Point at(std::size_t pixel) const {
    const std::size_t row = pixel / columns_, column = pixel % columns_;
    return {view_.box.xmin + (static_cast<double>(column) + 0.5) / view_.width * width_,
            view_.box.ymin + (static_cast<double>(row) + 0.5) / view_.height * height_};
  }

 private:
  const View& view_;
  double width_, height_;
  std::size_t columns_;
};

constexpr std::size_t grain = 1024;

}  // namespace

void nearestSites(const NearestSite& nearest, const View& view, int threads, std::span<std::uint32_t> out) {
  const Centers centers(view);
  parallelFor(out.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      out[pixel] = nearest.at(view.corner, centers.at(pixel));
    }
  });
}

void nearestSites(const NearestSite& nearest, const View& view, std::span<const std::uint32_t> pixels,
                  int threads, std::span<std::uint32_t> out) {
  const Centers centers(view);
  parallelFor(pixels.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) out[k] = nearest.at(view.corner, centers.at(pixels[k]));
  });
}

}  // namespace vorpipe::cpu
