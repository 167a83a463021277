#include <fmt/core.h>

#include <nanoflann.hpp>
#include <random>

#include "check/space.h"

namespace vorpipe::core::checks {
namespace {

constexpr std::size_t most_cells = 10'000, most_of_domain = 20'000, places_of_site = 256,
                      least_of_domain = 2'000;
/// Sampled vertices per cell; few cells have more.
constexpr std::size_t most_of_cell = 32;

/// Sites, except those that another at their position stands for.
struct SpaceCloud {
  const CheckedSpace& run;
  std::vector<std::uint32_t> index;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return index.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t k, std::size_t axis) const {
    const Point3& p = run.sites[index[k]];
    return run.scale * (axis == 0 ? p.x : axis == 1 ? p.y : p.z);
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using SpaceMetric = nanoflann::L2_Simple_Adaptor<double, SpaceCloud, double, std::uint32_t>;
using SpaceTree = nanoflann::KDTreeSingleIndexAdaptor<SpaceMetric, SpaceCloud, 3, std::uint32_t>;

class NearestInSpace {
 public:
  explicit NearestInSpace(const CheckedSpace& run)
      : cloud_{run, {}}, tree_(3, withSites(cloud_), {leaf_size}) {}

  /// The nearest site; of several that double cannot tell apart any.
  [[nodiscard]] std::uint32_t at(const Point3& p) const {
    const double place[3] = {p.x, p.y, p.z};
    std::uint32_t nearest = 0;
    double squared = 0;
    tree_.knnSearch(place, 1, &nearest, &squared);
    return cloud_.index[nearest];
  }

 private:
  static constexpr std::size_t leaf_size = 16;

  static SpaceCloud& withSites(SpaceCloud& cloud) {
    const CheckedSpace& run = cloud.run;
    for (std::uint32_t i = 0; i < run.size(); ++i) {
      const std::uint32_t owner = run.diagram.owner[i];
      const bool stands = owner != i && owner < run.size() && run.diagram.owner[owner] == owner &&
                          run.sites[owner] == run.sites[i];
      if (!stands) cloud.index.push_back(i);
    }
    return cloud;
  }

  SpaceCloud cloud_;
  SpaceTree tree_;
};

std::string wrongPlaceOf(const CheckedSpace& run, const NearestInSpace& nearest, std::size_t i,
                         const Point3& p, double slack) {
  const std::uint32_t other = nearest.at(p);
  if (other == i || run.sites[other] == run.sites[i]) return {};
  if (run.beyond(i, other, p) <= slack) return {};
  return fmt::format("{} in the cell of site {} is nearer to site {}", run.text(p), i, other);
}

/// What is wrong with the sampled places of cell i: its centroid and vertices.
std::string wrongCellOf(const CheckedSpace& run, const NearestInSpace& nearest, std::size_t i) {
  const double slack = run.slack(i);
  std::string wrong = wrongPlaceOf(run, nearest, i, run.centroid(i), slack);
  if (!run.polyhedra() || run.faces(i) == 0) return wrong;
  const std::size_t begin = run.diagram.face_vertex_offsets[run.begin(i)],
                    end = run.diagram.face_vertex_offsets[run.end(i)];
  const std::size_t step = 1 + (end - begin) / 3 / most_of_cell;  // each vertex is in three faces or more
  for (std::size_t k = begin; k < end && wrong.empty(); k += step)
    wrong = wrongPlaceOf(run, nearest, i, run.vertex(run.diagram.face_vertices[k]), slack);
  return wrong;
}

/// Whether p lies in the polyhedron of its nearest site.
std::string wrongNearestCell(const CheckedSpace& run, const NearestInSpace& nearest, const Point3& p) {
  const std::size_t i = nearest.at(p);
  if (!run.ok(i)) return fmt::format("{} is nearest to site {}, which has no cell", run.text(p), i);
  if (!run.polyhedra()) return {};
  const double slack = run.slack(i);
  for (std::size_t face = run.begin(i); face < run.end(i); ++face) {
    const auto ring = run.ring(face);
    const Point3 first = run.vertex(ring[0]);
    Vector3 twice{0, 0, 0};
    for (std::size_t k = 2; k < ring.size(); ++k)
      twice = twice + cross(run.vertex(ring[k - 1]) - first, run.vertex(ring[k]) - first);
    // The plane through a very thin ring is that of its rounding.
    const double thin = 1e-3 * run.surface(i);
    if (length(twice) <= thin || dot(p - first, twice) <= 8 * slack * length(twice)) continue;
    return fmt::format("{} is nearest to site {}, but lies beyond the face of its cell to {}", run.text(p), i,
                       run.diagram.neighbors[face]);
  }
  return {};
}

}  // namespace

void checkNearestInSpace(const CheckedSpace& run, Broken& broken) {
  const NearestInSpace nearest(run);
  std::mt19937_64 random(1);
  std::vector<std::uint32_t> cells;
  for (std::uint32_t i = 0; i < run.size(); ++i) {
    if (run.ok(i)) cells.push_back(i);
  }
  const std::size_t count = std::min(cells.size(), most_cells);
  for (std::size_t k = 0; k < count; ++k) std::swap(cells[k], cells[k + random() % (cells.size() - k)]);
  cells.resize(count);
  constexpr std::size_t grain = 64;
  const auto sampled = [&](std::string_view promise, std::size_t places, const auto& wrong) {
    std::vector<std::string> found(places);
    parallelEach(places, grain, run.threads, [&](std::size_t k) { found[k] = wrong(k); });
    broken.expect(promise, places, 1, [&](std::size_t k) { return found[k]; });
  };
  sampled("nearest", count, [&](std::size_t k) { return wrongCellOf(run, nearest, cells[k]); });
  const auto along = [&](double low, double high) {
    return low + static_cast<double>(random() >> 11) * 0x1p-53 * (high - low);
  };
  std::vector<Point3> places(std::clamp(places_of_site * run.size(), least_of_domain, most_of_domain));
  for (Point3& p : places) {
    p.x = along(run.box.xmin, run.box.xmax);
    p.y = along(run.box.ymin, run.box.ymax);
    p.z = along(run.box.zmin, run.box.zmax);
  }
  sampled("places", places.size(), [&](std::size_t k) { return wrongNearestCell(run, nearest, places[k]); });
}

}  // namespace vorpipe::core::checks
