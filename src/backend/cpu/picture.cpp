#include "backend/cpu/picture.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "parallel.h"

namespace vorpipe::cpu {
namespace {

/// The sites, but for heavy ones, as points; with weights, as points above the plane: the square of a site's
/// height is by how much it is lighter than the heaviest of them, so that distances rank as powers do.
template <std::size_t Dimensions>
class Cloud {
 public:
  explicit Cloud(const SiteSet& sites) : sites_(sites), site_(sites.size()) {
    std::iota(site_.begin(), site_.end(), 0U);
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
    return (axis == 0 ? sites_.x : sites_.y)[site_[point]];
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }

 private:
  const SiteSet& sites_;
  std::vector<std::uint32_t> site_;  // by point
  std::vector<double> height_;       // by point
};

/// Squared distances that differ by less than this part of themselves may be in either order.
constexpr double near_tie = 1e-14;

/// Whether (x, y) is nearer to b than to a: from differences, never from squared distances.
bool isNearerTo(const SiteSet& s, std::uint32_t b, std::uint32_t a, double x, double y) {
  const double towards =
      ((x - s.x[a]) + (x - s.x[b])) * (s.x[b] - s.x[a]) + ((y - s.y[a]) + (y - s.y[b])) * (s.y[b] - s.y[a]);
  return towards + (s.weight.empty() ? 0 : s.weight[b] - s.weight[a]) > 0;
}

template <std::size_t Dimensions>
class CloudTree {
 public:
  explicit CloudTree(const SiteSet& sites) : sites_(sites), cloud_(sites), index_(Dimensions, cloud_, {16}) {}

  [[nodiscard]] bool isEmpty() const { return cloud_.kdtree_get_point_count() == 0; }

  [[nodiscard]] std::uint32_t nearest(double x, double y) const {
    const std::array<double, 3> point{x, y, 0};
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
      if (isNearerTo(sites_, site, best, x, y)) best = site;
    }
    return best;
  }

 private:
  using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud<Dimensions>, double, std::uint32_t>;

  const SiteSet& sites_;
  Cloud<Dimensions> cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud<Dimensions>, Dimensions, std::uint32_t> index_;
};

}  // namespace

struct NearestSite::Tree {
  explicit Tree(const SiteSet& set) : sites(set) {
    if (sites.weight.empty()) {
      flat.emplace(sites);
    } else {
      lifted.emplace(sites);
    }
  }

  const SiteSet& sites;
  std::optional<CloudTree<2>> flat;
  std::optional<CloudTree<3>> lifted;
};

NearestSite::NearestSite(const SiteSet& sites) : tree_(std::make_unique<Tree>(sites)) {}
NearestSite::~NearestSite() = default;

std::uint32_t NearestSite::at(double x, double y) const {
  if (tree_->flat) return tree_->flat->nearest(x, y);
  const auto& sites = tree_->sites;
  auto best = tree_->lifted->isEmpty() ? sites.heavy.front() : tree_->lifted->nearest(x, y);
  for (const auto heavy : sites.heavy) {
    if (isNearerTo(sites, heavy, best, x, y)) best = heavy;
  }
  return best;
}

void nearestSites(const NearestSite& nearest, const View& view, int threads, std::span<std::uint32_t> out) {
  const double width = view.box.xmax - view.box.xmin;
  const double height = view.box.ymax - view.box.ymin;
  const auto columns = static_cast<std::size_t>(view.width);
  parallelFor(static_cast<std::size_t>(view.height), 4, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const double y = view.box.ymin + (static_cast<double>(row) + 0.5) / view.height * height;
      for (std::size_t column = 0; column < columns; ++column) {
        const double x = view.box.xmin + (static_cast<double>(column) + 0.5) / view.width * width;
        out[row * columns + column] = nearest.at(x, y);
      }
    }
  });
}

}  // namespace vorpipe::cpu
