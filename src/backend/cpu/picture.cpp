#include "backend/cpu/picture.h"

#include <nanoflann.hpp>

#include "parallel.h"

namespace vorpipe::cpu {
namespace {

struct Cloud {
  const SiteSet& sites;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return sites.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t i, std::size_t axis) const {
    return axis == 0 ? sites.x[i] : sites.y[i];
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud, double, std::uint32_t>;
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 2, std::uint32_t>;

/// Squared distances that differ by less than this part of themselves may be in either order.
constexpr double near_tie = 1e-14;

}  // namespace

struct NearestSite::Tree {
  explicit Tree(const SiteSet& sites) : cloud{sites}, index(2, cloud, {16}) {}

  /// Positive when (x, y) is nearer to b than to a: from differences, never from squared distances.
  [[nodiscard]] double towards(double x, double y, std::uint32_t a, std::uint32_t b) const {
    const auto& s = cloud.sites;
    return ((x - s.x[a]) + (x - s.x[b])) * (s.x[b] - s.x[a]) +
           ((y - s.y[a]) + (y - s.y[b])) * (s.y[b] - s.y[a]);
  }

  Cloud cloud;
  KdTree index;
};

NearestSite::NearestSite(const SiteSet& sites) : tree_(std::make_unique<Tree>(sites)) {}
NearestSite::~NearestSite() = default;

std::uint32_t NearestSite::at(double x, double y) const {
  const double point[2] = {x, y};
  std::uint32_t found[2] = {0, 0};
  double squared[2] = {0, 0};
  const auto count = tree_->index.knnSearch(point, 2, found, squared);
  if (count < 2 || squared[1] > squared[0] * (1 + near_tie)) return found[0];

  std::vector<std::pair<std::uint32_t, double>> tied;
  tree_->index.radiusSearch(point, squared[0] * (1 + near_tie), tied, nanoflann::SearchParams(32, 0, true));
  auto best = found[0];
  for (const auto& candidate : tied) {
    if (tree_->towards(x, y, best, candidate.first) > 0) best = candidate.first;
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
