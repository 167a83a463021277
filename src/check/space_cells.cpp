#include <fmt/core.h>

#include <numeric>

#include "check/space.h"

namespace vorpipe::core::checks {
namespace {

/// The areas of one face in both of its cells may differ by this part of their surfaces.
constexpr double area_rounding = 1e-8;

Shift3 opposed(const Shift3& by) { return {-by[0], -by[1], -by[2]}; }

bool isSameRing(std::span<const std::uint32_t> ring, std::span<const std::uint32_t> other) {
  const auto start = std::ranges::find(other, ring.empty() ? 0 : ring.front());
  bool same = ring.size() == other.size() && start != other.end();
  for (std::size_t k = 0; same && k < ring.size(); ++k) {
    const auto at = static_cast<std::size_t>(start - other.begin()) + other.size() - k;
    same = ring[k] == other[at % other.size()];
  }
  return same;
}

/// Whether the ring of the neighbor's cell, moved, has the places of that of cell i, in the other order.
bool isMovedRing(const CheckedSpace& run, std::size_t i, std::span<const std::uint32_t> ring,
                 std::span<const std::uint32_t> other, const Shift3& by) {
  if (ring.size() != other.size()) return false;
  if (ring.empty()) return true;
  const Vector3 move = run.period.of(by);
  const auto apart = [&](std::uint32_t v, std::uint32_t w) {
    return length(run.vertex(w) + move - run.vertex(v));
  };
  // Several vertices may be as near to the first as ties are long.
  const double slack = run.slack(i);
  for (std::size_t start = 0; start < other.size(); ++start) {
    bool same = true;
    for (std::size_t k = 0; same && k < ring.size(); ++k)
      same = apart(ring[k], other[(start + other.size() - k) % other.size()]) <= slack;
    if (same) return true;
  }
  return false;
}

/// What is wrong with the faces of cell i in its neighbors' cells.
std::string wrongTwinOfFace(const CheckedSpace& run, std::size_t i) {
  for (std::size_t face = run.begin(i); face < run.end(i); ++face) {
    const std::int64_t neighbor = run.diagram.neighbors[face];
    if (neighbor < 0 || static_cast<std::size_t>(neighbor) < i) continue;
    const auto j = static_cast<std::size_t>(neighbor);
    const Shift3 by = run.shift(face);
    const auto twin = run.faceTo(j, static_cast<std::int64_t>(i), opposed(by));
    if (!twin)
      return fmt::format("site {} has the neighbor {}, which does not have it", i, run.name(neighbor, by));
    const double slack = area_rounding * (run.surface(i) + run.surface(j)) + epsilon * run.largest;
    if (!(std::abs(run.area(face) - run.area(*twin)) <= slack)) {
      return fmt::format("the face of sites {} and {} has the areas {} and {}", i, j,
                         run.diagram.face_areas[face], run.diagram.face_areas[*twin]);
    }
    if (!run.polyhedra()) continue;
    // Of sites in different periods, vertices are others at the same place.
    const bool same = (by == Shift3{} && isSameRing(run.ring(face), run.ring(*twin))) ||
                      (run.period.repeats() && isMovedRing(run, i, run.ring(face), run.ring(*twin), by));
    if (!same) return fmt::format("the face of sites {} and {} has another ring in each cell", i, j);
  }
  return {};
}

/// What is wrong with neighbors that have a smaller index: each names this one in wrongTwinOfFace of its own.
std::string missingInLower(const CheckedSpace& run, std::size_t i) {
  for (std::size_t face = run.begin(i); face < run.end(i); ++face) {
    const std::int64_t neighbor = run.diagram.neighbors[face];
    if (neighbor < 0 || static_cast<std::size_t>(neighbor) > i) continue;
    const Shift3 by = run.shift(face);
    if (!run.faceTo(static_cast<std::size_t>(neighbor), static_cast<std::int64_t>(i), opposed(by)))
      return fmt::format("site {} has the neighbor {}, which does not have it", i, run.name(neighbor, by));
  }
  return {};
}

/// What does not follow from the areas of cell i and the planes that its neighbors name.
std::string wrongFromAreas(const CheckedSpace& run, std::size_t i) {
  if (!run.ok(i)) return {};
  Vector3 sum{0, 0, 0};
  double areas = 0, volume = 0, farthest = 0;
  const Point3 site = run.site(i);
  for (std::size_t face = run.begin(i); face < run.end(i); ++face) {
    const Plane3 plane = run.plane(i, face);
    const double area = run.area(face), height = -plane.beyond(site);
    sum = sum + area * plane.normal;
    areas += area;
    volume += area * height / 3;
    farthest = std::max(farthest, std::abs(height));
  }
  // Faces that ties removed are as thin as ties; their sites, which are no neighbors, are as far away as the
  // cell is wide.
  const double surface = std::max(run.surface(i), areas), side = std::sqrt(surface),
               slack = std::max(run.slack(i), tie_slack * side);
  if (!(length(sum) <= 8 * slack * side))
    return fmt::format("the faces of site {} do not close: their areas add up to {} of the surface", i,
                       length(sum) / surface);
  if (!(std::abs(areas - run.surface(i)) <= 8 * slack * side)) {
    return fmt::format("the faces of site {} have the area {}, its surface {}", i,
                       areas / run.scale / run.scale, run.diagram.surface[i]);
  }
  if (std::abs(volume - run.volume(i)) <= slack * (surface + farthest * side)) return {};
  return fmt::format("site {} has the volume {}, but its faces enclose {}", i, run.diagram.volume[i],
                     volume / run.scale / run.scale / run.scale);
}

}  // namespace

void checkSpaceMeasures(const CheckedSpace& run, Broken& broken) {
  const double domain = run.volume_of_all;
  const double sum = volumeSum(run.diagram) * run.scale * run.scale * run.scale;
  constexpr double volume_sum_slack = 1e-12, steps = 4;
  // Positions across a flat domain are rounded as much as along it.
  const double slack = volume_sum_slack + steps * epsilon * std::max(run.largest, 2.0) / run.flattest;
  if (!(std::abs(sum - domain) <= slack * domain)) {
    const double unit = run.scale * run.scale * run.scale;
    broken.add("volumes", fmt::format("they add up to {}, the domain has {} ({:.1e} of it more)", sum / unit,
                                      domain / unit, sum / domain - 1));
  }
  broken.expect("symmetry", run.size(), run.threads, [&](std::size_t i) {
    std::string wrong = wrongTwinOfFace(run, i);
    return wrong.empty() ? missingInLower(run, i) : wrong;
  });
  broken.expect("measures", run.size(), run.threads, [&](std::size_t i) { return wrongFromAreas(run, i); });
}

}  // namespace vorpipe::core::checks
