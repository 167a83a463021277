#include <fmt/core.h>

#include <nanoflann.hpp>
#include <optional>
#include <random>

#include "check/space.h"

namespace vorpipe::core::checks {
namespace {

constexpr std::size_t most_cells = 10'000, most_of_domain = 20'000, places_of_site = 256,
                      least_of_domain = 2'000;
/// Sampled vertices per cell; few cells have more.
constexpr std::size_t most_of_cell = 32;

/// Sites, except those that another at their position stands for. With weights they stand at a height in a
/// fourth dimension, so that squared distances from height 0 are powers, but for a constant.
struct SpaceCloud {
  const CheckedSpace& run;
  std::vector<std::uint32_t> index;
  std::vector<double> height;   ///< all 0 without weights
  std::vector<Point3> place{};  ///< scaled; of sites that repeat, one in the period around the origin
  std::vector<Shift3> steps{};  ///< of the period's basis, from there to the site
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return index.size(); }
  [[nodiscard]] double kdtree_get_pt(std::uint32_t k, std::size_t axis) const {
    if (axis == 3) return height[k];
    const Point3& p = place[k];
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using SpaceMetric = nanoflann::L2_Simple_Adaptor<double, SpaceCloud, double, std::uint32_t>;
using SpaceTree = nanoflann::KDTreeSingleIndexAdaptor<SpaceMetric, SpaceCloud, 4, std::uint32_t>;

class NearestInSpace {
 public:
  explicit NearestInSpace(const CheckedSpace& run)
      : cloud_{run, {}, {}}, tree_(4, withSites(cloud_), {leaf_size}) {
    std::ranges::fill(low_, std::numeric_limits<double>::infinity());
    std::ranges::fill(high_, -std::numeric_limits<double>::infinity());
    for (const Point3& p : cloud_.place) {
      for (std::size_t r = 0; r < run.period.basis().size(); ++r) {
        low_[r] = std::min(low_[r], run.period.part(r, p));
        high_[r] = std::max(high_[r], run.period.part(r, p));
      }
    }
  }

  /// An image of a site.
  struct Near {
    std::uint32_t site;
    Shift3 shift;
  };

  /// The nearest site or image, with weights that of least power; of several that double cannot tell apart
  /// any.
  [[nodiscard]] Near at(const Point3& p) const {
    Found best;
    eachNear(p, 1, best.squared, [&](const Found& found) {
      if (found.squared < best.squared) best = found;
    });
    Near near{cloud_.index[best.place], {}};
    for (std::size_t r = 0; r < basis().size(); ++r) {
      const std::int32_t steps = best.steps[r] - cloud_.steps[best.place][r];
      for (std::size_t k = 0; k < 3; ++k) near.shift[k] += steps * basis()[r].shift[k];
    }
    if (cloud_.run.weighted && !cloud_.run.period.repeats()) near.site = nearestByPlanes(p, best.squared);
    return near;
  }

  /// Whether a site is the nearest to its own place, and all others are clearly farther.
  [[nodiscard]] bool isOwn(std::uint32_t site) const {
    double own = std::numeric_limits<double>::infinity(), other = own;
    eachNear(cloud_.run.site(site), 2, other, [&](const Found& found) {
      double& nearest = cloud_.index[found.place] == site ? own : other;
      nearest = std::min(nearest, found.squared);
    });
    return own < (1 - 1e-9) * other;
  }

  /// A site with a cell that double cannot tell from the nearest, if there is one: of sites far outside the
  /// domain many are as near.
  [[nodiscard]] std::optional<std::uint32_t> withCell(const Point3& p) const {
    const CheckedSpace& run = cloud_.run;
    const double place[4] = {p.x, p.y, p.z, 0};
    std::vector<std::uint32_t> found;
    std::vector<double> squared;
    for (std::size_t count = 1; count < cloud_.index.size();) {
      count = std::min(8 * count, cloud_.index.size());
      found.resize(count);
      squared.resize(count);
      tree_.knnSearch(place, count, found.data(), squared.data());
      const std::uint32_t first = cloud_.index[found[0]];
      bool near = true;
      for (std::size_t k = 1; k < count; ++k) {
        const std::uint32_t i = cloud_.index[found[k]];
        near = run.beyond(i, first, p) <= run.slack(i);
        if (near && run.ok(i)) return i;
      }
      if (!near) break;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t leaf_size = 16;

  /// Heights may be large numbers, so that double does not tell powers apart: the planes between these sites
  /// do.
  [[nodiscard]] std::uint32_t nearestByPlanes(const Point3& p, double least) const {
    const double place[4] = {p.x, p.y, p.z, 0}, limit = least * (1 + 64 * epsilon);
    std::vector<std::uint32_t> found;
    std::vector<double> squared;
    std::size_t count = 0;
    for (std::size_t wanted = 4; count == found.size(); wanted *= 4) {
      found.resize(wanted);
      squared.resize(wanted);
      const std::size_t all = tree_.knnSearch(place, wanted, found.data(), squared.data());
      const auto end = squared.begin() + static_cast<std::ptrdiff_t>(all);
      count = static_cast<std::size_t>(std::upper_bound(squared.begin(), end, limit) - squared.begin());
    }
    std::uint32_t nearest = cloud_.index[found[0]];
    for (std::size_t k = 1; k < count; ++k) {
      const std::uint32_t other = cloud_.index[found[k]];
      if (cloud_.run.sites[other] != cloud_.run.sites[nearest] && cloud_.run.beyond(nearest, other, p) > 0)
        nearest = other;
    }
    return nearest;
  }

  struct Found {
    std::uint32_t place = 0;  ///< of the cloud
    Shift3 steps{};           ///< of the basis, from there to the image
    double squared = std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] const std::vector<SpacePeriod::Step>& basis() const { return cloud_.run.period.basis(); }

  /// Calls take with the `count` nearest sites of each period that may have one nearer than `squared`, which
  /// take lessens.
  template <class Take>
  void eachNear(const Point3& p, std::size_t count, const double& squared, const Take& take) const {
    const SpacePeriod& period = cloud_.run.period;
    const Shift3 home = period.stepsTo(p);
    const Point3 from = period.less(p, home);
    const auto look = [&](const Shift3& steps) {
      const Point3 at = period.less(from, steps);
      const double place[4] = {at.x, at.y, at.z, 0};
      std::uint32_t index[2] = {};
      double distance[2] = {};
      const std::size_t found = tree_.knnSearch(place, count, index, distance);
      for (std::size_t k = 0; k < found; ++k)
        take(Found{index[k], {home[0] + steps[0], home[1] + steps[1], home[2] + steps[2]}, distance[k]});
    };
    look({});
    if (!period.repeats()) return;
    std::array<std::array<std::int32_t, 2>, 3> range{};
    for (std::size_t r = 0; r < basis().size(); ++r) {
      const double part = period.part(r, from), reach = std::sqrt(squared) * period.partOfLength(r) + 1e-9;
      range[r] = {static_cast<std::int32_t>(std::ceil(part - high_[r] - reach)),
                  static_cast<std::int32_t>(std::floor(part - low_[r] + reach))};
    }
    Shift3 steps{};
    for (steps[0] = range[0][0]; steps[0] <= range[0][1]; ++steps[0]) {
      for (steps[1] = range[1][0]; steps[1] <= range[1][1]; ++steps[1]) {
        for (steps[2] = range[2][0]; steps[2] <= range[2][1]; ++steps[2]) {
          if (steps != Shift3{}) look(steps);
        }
      }
    }
  }

  static SpaceCloud& withSites(SpaceCloud& cloud) {
    const CheckedSpace& run = cloud.run;
    for (std::uint32_t i = 0; i < run.size(); ++i) {
      const std::uint32_t owner = run.diagram.owner[i];
      const bool stands = owner != i && owner < run.size() && run.diagram.owner[owner] == owner &&
                          (run.period.repeats() || run.sites[owner] == run.sites[i]);
      if (!stands) cloud.index.push_back(i);
    }
    if (run.weighted) leaveFarOnes(cloud);
    for (const std::uint32_t i : cloud.index) {
      const Point3 p = run.site(i);
      cloud.steps.push_back(run.period.stepsTo(p));
      cloud.place.push_back(run.period.less(p, cloud.steps.back()));
    }
    cloud.height.assign(cloud.index.size(), 0);
    if (!run.weighted) return cloud;
    std::uint32_t heaviest = cloud.index[0];
    for (const std::uint32_t i : cloud.index) heaviest = run.heavier(i, heaviest) > 0 ? i : heaviest;
    for (std::size_t k = 0; k < cloud.index.size(); ++k)
      cloud.height[k] = std::sqrt(run.heavier(heaviest, cloud.index[k]));
    return cloud;
  }

  /// Leaves out sites that are nowhere in the domain nearest, because some other has a lesser power all over
  /// it: they may be so much lighter that heights lose all digits.
  static void leaveFarOnes(SpaceCloud& cloud) {
    const CheckedSpace& run = cloud.run;
    struct Powers {
      double least = 0, most = 0;
    };
    const auto powersOf = [&run](std::uint32_t i) {
      const Point3 p = run.site(i);
      Powers powers;
      const auto along = [&powers](bool repeats, double at, double low, double high) {
        if (repeats) return;
        const double near = std::max({low - at, 0.0, at - high}), far = std::max(at - low, high - at);
        powers.least += near * near;
        powers.most += far * far;
      };
      along(run.period.along(0), p.x, run.box.xmin, run.box.xmax);
      along(run.period.along(1), p.y, run.box.ymin, run.box.ymax);
      along(run.period.along(2), p.z, run.box.zmin, run.box.zmax);
      // No place is farther from some image than half of each vector.
      for (const auto& step : run.period.basis()) powers.most += dot(step.way, step.way) / 4;
      const double heavier = run.heavier(i, 0);
      return Powers{powers.least - heavier, powers.most - heavier};
    };
    double bound = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : cloud.index) bound = std::min(bound, powersOf(i).most);
    std::erase_if(cloud.index, [&](std::uint32_t i) {
      const double least = powersOf(i).least;
      return least > bound + 64 * epsilon * (std::abs(bound) + std::abs(least));
    });
  }

  SpaceCloud cloud_;
  SpaceTree tree_;
  std::array<double, 3> low_{}, high_{};  ///< of the places, by parts of the basis
};

std::string wrongPlaceOf(const CheckedSpace& run, const NearestInSpace& nearest, std::size_t i,
                         const Point3& p, double slack) {
  const auto [other, by] = nearest.at(p);
  const bool is_itself = other == i && by == Shift3{};
  if (is_itself || (!run.period.repeats() && run.sites[other] == run.sites[i])) return {};
  if (run.beyond(i, other, p, by) <= slack) return {};
  return fmt::format("{} in the cell of site {} is nearer to site {}", run.text(p), i, run.name(other, by));
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

/// The nearest site, of which site i is one that squared distances do not tell from it: another may be so
/// near to it that their bisector, a difference, alone tells.
std::size_t nearestAround(const CheckedSpace& run, std::size_t i, const Point3& p) {
  for (bool moved = true; moved;) {
    moved = false;
    const double slack = run.slack(i);
    for (std::size_t face = run.begin(i); face < run.end(i) && !moved; ++face) {
      const std::int64_t neighbor = run.diagram.neighbors[face];
      moved = neighbor >= 0 && run.beyond(i, static_cast<std::size_t>(neighbor), p) > slack;
      if (moved) i = static_cast<std::size_t>(neighbor);
    }
  }
  return i;
}

/// Whether p lies in the polyhedron of its nearest site.
std::string wrongNearestCell(const CheckedSpace& run, const NearestInSpace& nearest, const Point3& sampled) {
  const auto [site, by] = nearest.at(sampled);
  const Point3 p = sampled - run.period.of(by);  // beside the site
  std::optional<std::size_t> found = site;
  if (!run.ok(site)) found = run.period.repeats() ? std::nullopt : nearest.withCell(p);
  if (!found) return fmt::format("{} is nearest to site {}, which has no cell", run.text(p), site);
  if (!run.polyhedra()) return {};
  const std::size_t i = run.period.repeats() ? *found : nearestAround(run, *found, p);
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
  if (run.weighted) {
    broken.expect("statuses", run.size(), run.threads, [&](std::size_t i) {
      const auto site = static_cast<std::uint32_t>(i);
      const bool wrong =
          run.diagram.status[i] == Status::empty && run.inDomain(run.site(i)) && nearest.isOwn(site);
      return wrong ? fmt::format("site {} is empty, but nearest to its own place", i) : std::string();
    });
  }
  sampled("nearest", count, [&](std::size_t k) { return wrongCellOf(run, nearest, cells[k]); });
  const auto part = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Point3> places(std::clamp(places_of_site * run.size(), least_of_domain, most_of_domain));
  for (Point3& p : places) {
    const double u = part(), v = part(), w = part();
    p = run.placeAt({u, v, w});
  }
  sampled("places", places.size(), [&](std::size_t k) { return wrongNearestCell(run, nearest, places[k]); });
}

}  // namespace vorpipe::core::checks
