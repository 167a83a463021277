#include "natural_neighbors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/double_double.h"
#include "base/parallel.h"
#include "geometry/predicates.h"
#include "triangle_signs.h"

namespace vorpipe::python {
namespace {

using Number = DoubleDouble;
struct Vector {
  Number x, y;
};

/// Exactly, unless it underflows.
Vector from(const Point& origin, const Point& point) {
  return {Number::sum(point.x, -origin.x), Number::sum(point.y, -origin.y)};
}

Number cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

/// The center of the circle through the origin, a and b.
Vector centerOf(const Vector& a, const Vector& b) {
  const Number aa = a.x * a.x + a.y * a.y, bb = b.x * b.x + b.y * b.y;
  const Number twice = Number(2) * cross(a, b);
  return {(b.y * aa - a.y * bb) / twice, (a.x * bb - b.x * aa) / twice};
}

struct Side {
  std::size_t triangle, corner;  ///< opposite to it
};

/// Which cells the cell of a place would take which areas from. Its corners and those that it covers are
/// centers of circles, far away where triangles are flat: numbers of twice as many digits keep what areas
/// differ by.
class Theft {
 public:
  Theft(const Delaunay& mesh, const Point& place) : mesh_(mesh), place_(place) {}

  /// Goes over the triangles whose circles hold the place, from one of them, and sums up.
  void commit(std::size_t first) {
    const Vector center = centerOfTriangle(first);
    // Sides come counter-clockwise: those of a triangle beyond one take its place.
    for (const std::size_t corner : {2u, 1u, 0u}) open_.push_back({{first, corner}, center});
    while (!open_.empty()) {
      const auto [side, inner] = open_.back();
      open_.pop_back();
      const Triangle& triangle = mesh_.triangles[side.triangle];
      const std::uint32_t begin = triangle[(side.corner + 1) % 3], end = triangle[(side.corner + 2) % 3];
      const std::int32_t other = mesh_.adjacent[side.triangle][side.corner];
      if (other < 0 || !holdsPlace(static_cast<std::size_t>(other))) {
        const Vector corner = centerOf(from(place_, mesh_.points[begin]), from(place_, mesh_.points[end]));
        border_.push_back({begin, end, corner});
        turn(begin, end, corner, inner);
        continue;
      }
      const auto beyond = static_cast<std::size_t>(other);
      const Vector center_beyond = centerOfTriangle(beyond);
      turn(begin, end, center_beyond, inner);
      const Adjacent& back = mesh_.adjacent[beyond];
      const auto entered = static_cast<std::size_t>(
          std::ranges::find(back, static_cast<std::int32_t>(side.triangle)) - back.begin());
      open_.push_back({{beyond, (entered + 2) % 3}, center_beyond});
      open_.push_back({{beyond, (entered + 1) % 3}, center_beyond});
    }
    for (std::size_t k = 0; k < border_.size(); ++k) {
      const auto& [begin, end, corner] = border_[k];
      parts_.push_back({end, cross(corner, border_[(k + 1) % border_.size()].corner)});
    }
  }

  /// Appends each site once, in ascending order, with its part of the whole.
  void share(std::vector<std::int32_t>& sites, std::vector<double>& weights) {
    std::ranges::stable_sort(parts_, {}, &Part::site);
    Number whole(0);
    for (const Part& part : parts_) whole = whole + part.area;
    for (std::size_t k = 0; k < parts_.size();) {
      const std::uint32_t site = parts_[k].site;
      Number area(0);
      for (; k < parts_.size() && parts_[k].site == site; ++k) area = area + parts_[k].area;
      sites.push_back(static_cast<std::int32_t>(site));
      weights.push_back(static_cast<double>(area / whole));
    }
  }

 private:
  struct Open {
    Side side;
    Vector center;  ///< of its triangle's circle
  };
  struct Border {
    std::uint32_t begin, end;
    Vector corner;  ///< of the new cell, between the cells of both
  };
  struct Part {
    std::uint32_t site;
    Number area;  ///< twice
  };

  [[nodiscard]] const Point& corner(std::size_t triangle, std::size_t k) const {
    return mesh_.points[mesh_.triangles[triangle][k]];
  }

  [[nodiscard]] bool holdsPlace(std::size_t t) const {
    return core::inCircle(corner(t, 0), corner(t, 1), corner(t, 2), place_) > 0;
  }

  [[nodiscard]] Vector centerOfTriangle(std::size_t t) const {
    const Vector first = from(place_, corner(t, 0));
    const Vector center = centerOf(from(corner(t, 0), corner(t, 1)), from(corner(t, 0), corner(t, 2)));
    return {first.x + center.x, first.y + center.y};
  }

  /// The border between the cells of two sites, from `outer` to `inner`, goes around what is taken from
  /// `begin`, and the other way around what is taken from `end`.
  void turn(std::uint32_t begin, std::uint32_t end, const Vector& outer, const Vector& inner) {
    const Number area = cross(outer, inner);
    parts_.push_back({begin, area});
    parts_.push_back({end, -area});
  }

  const Delaunay& mesh_;
  const Point place_;
  std::vector<Open> open_;
  std::vector<Border> border_;
  std::vector<Part> parts_;
};

/// Where a walk through the triangles towards a place ends: in one that holds it, or before a side of the
/// hull beyond which it lies.
struct Found {
  Side side;
  bool inside;
};

Found walkTo(const Delaunay& mesh, const Point& place, std::size_t at) {
  for (;;) {
    const Triangle& triangle = mesh.triangles[at];
    std::size_t beyond = 3;
    for (std::size_t k = 0; k < 3 && beyond == 3; ++k) {
      const Point &a = mesh.points[triangle[(k + 1) % 3]], &b = mesh.points[triangle[(k + 2) % 3]];
      if (core::orientation(a, b, place) < 0) beyond = k;
    }
    if (beyond == 3) return {{at, 0}, true};
    if (mesh.adjacent[at][beyond] < 0) return {{at, beyond}, false};
    at = static_cast<std::size_t>(mesh.adjacent[at][beyond]);
  }
}

/// On a side of the hull, as far as doubles can tell, the place lies between two sites.
bool sharedOnHull(const Delaunay& mesh, const Point& place, const Side& side,
                  std::vector<std::int32_t>& sites, std::vector<double>& weights) {
  const Triangle& triangle = mesh.triangles[side.triangle];
  std::uint32_t low = triangle[(side.corner + 1) % 3], high = triangle[(side.corner + 2) % 3];
  if (low > high) std::swap(low, high);
  const Point &a = mesh.points[low], &b = mesh.points[high];
  if (!areOnLine(a, b, place)) return false;
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double along = ((place.x - a.x) * dx + (place.y - a.y) * dy) / (dx * dx + dy * dy);
  if (!(along >= 0 && along <= 1)) return false;
  for (const auto& [site, weight] : {std::pair(low, 1 - along), std::pair(high, along)}) {
    sites.push_back(static_cast<std::int32_t>(site));
    weights.push_back(weight);
  }
  return true;
}

void findAt(const Delaunay& mesh, const Point& place, std::size_t start, std::vector<std::int32_t>& sites,
            std::vector<double>& weights) {
  const Found found = walkTo(mesh, place, start);
  if (!found.inside) {
    sharedOnHull(mesh, place, found.side, sites, weights);
    return;
  }
  const std::size_t at = found.side.triangle;
  for (const std::uint32_t site : mesh.triangles[at]) {
    if (mesh.points[site].x != place.x || mesh.points[site].y != place.y) continue;
    sites.push_back(static_cast<std::int32_t>(site));
    weights.push_back(1);
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.adjacent[at][k] >= 0) continue;
    const Triangle& triangle = mesh.triangles[at];
    const Point &a = mesh.points[triangle[(k + 1) % 3]], &b = mesh.points[triangle[(k + 2) % 3]];
    if (core::orientation(a, b, place) != 0) continue;
    sharedOnHull(mesh, place, {at, k}, sites, weights);
    return;
  }
  Theft theft(mesh, place);
  theft.commit(at);
  theft.share(sites, weights);
}

}  // namespace

NaturalNeighbors naturalNeighbors(const Delaunay& mesh, std::span<const Point> places, int threads) {
  NaturalNeighbors all;
  all.offsets.assign(places.size() + 1, 0);
  if (mesh.triangles.empty()) return all;
  const auto near = trianglesAt(mesh.points, mesh.triangles, mesh.adjacent, places, 0);
  constexpr std::size_t grain = 1024;
  const std::size_t ranges = (places.size() + grain - 1) / grain;
  std::vector<NaturalNeighbors> parts(ranges);
  parallelFor(places.size(), grain, threadCount(threads), [&](std::size_t begin, std::size_t end) {
    NaturalNeighbors& part = parts[begin / grain];
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t before = part.sites.size();
      if (std::isfinite(places[i].x) && std::isfinite(places[i].y)) {
        const std::size_t start = near[i] < 0 ? 0 : static_cast<std::size_t>(near[i]);
        findAt(mesh, places[i], start, part.sites, part.weights);
      }
      all.offsets[i + 1] = static_cast<std::int64_t>(part.sites.size() - before);
    }
  });
  for (std::size_t i = 0; i < places.size(); ++i) all.offsets[i + 1] += all.offsets[i];
  for (const NaturalNeighbors& part : parts) {
    all.sites.insert(all.sites.end(), part.sites.begin(), part.sites.end());
    all.weights.insert(all.weights.end(), part.weights.begin(), part.weights.end());
  }
  return all;
}

}  // namespace vorpipe::python
