#include "core/check/nearest_site.h"

#include <nanoflann.hpp>

namespace vorpipe::checks {
namespace {

struct Cloud {
  const CheckedSites& run;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return run.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t i, std::size_t axis) const {
    return (axis == 0 ? run.sites.x[i] : run.sites.y[i]) * run.scale;
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud, double, std::uint32_t>;
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 2, std::uint32_t>;
constexpr std::size_t leaf_size = 16;

}  // namespace

struct NearestSite::Tree {
  explicit Tree(const CheckedSites& run) : cloud{run}, index(2, cloud, {leaf_size}) {}
  Cloud cloud;
  KdTree index;
};

NearestSite::NearestSite(const CheckedSites& run) : tree_(std::make_unique<Tree>(run)) {}
NearestSite::NearestSite(NearestSite&&) noexcept = default;
NearestSite::~NearestSite() = default;

std::uint32_t NearestSite::at(Point p) const {
  const double place[2] = {p.x, p.y};
  std::uint32_t found = 0;
  double squared = 0;
  tree_->index.knnSearch(place, 1, &found, &squared);
  return found;
}

}  // namespace vorpipe::checks
