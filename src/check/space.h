/// Cells in space for the checks. Nothing here relies on the code that computed them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "check/run.h"
#include "check/space_period.h"
#include "vorpipe.h"

namespace vorpipe::core::checks {

using Vector3 = Point3;

inline Vector3 operator-(const Point3& a, const Point3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector3 operator+(const Point3& a, const Point3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector3 operator*(double s, const Vector3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector3& a) { return std::sqrt(dot(a, a)); }

/// A plane: where dot(p, normal) = offset. The normal has length 1, and points out of a cell.
struct Plane3 {
  Vector3 normal;
  double offset;
  [[nodiscard]] double beyond(const Point3& p) const { return dot(p, normal) - offset; }
};

/// The cells of a run, scaled by a power of two so that the domain's longest side is in [1, 2).
struct CheckedSpace {
  CheckedSpace(std::span<const Point3> of, const Cells3Options& options, const Diagram3& result,
               int thread_count);

  [[nodiscard]] std::size_t size() const { return sites.size(); }
  [[nodiscard]] bool ok(std::size_t i) const { return diagram.status[i] == Status::ok; }
  [[nodiscard]] bool polyhedra() const { return detail == Detail3::polyhedra; }
  [[nodiscard]] Point3 scaled(const Point3& p) const { return scale * p; }
  [[nodiscard]] Point3 site(std::size_t i) const { return scaled(sites[i]); }
  [[nodiscard]] Point3 vertex(std::size_t v) const { return scaled(diagram.vertices[v]); }
  [[nodiscard]] Point3 centroid(std::size_t i) const { return scaled(diagram.centroid[i]); }
  [[nodiscard]] double volume(std::size_t i) const { return diagram.volume[i] * scale * scale * scale; }
  [[nodiscard]] double surface(std::size_t i) const { return diagram.surface[i] * scale * scale; }
  [[nodiscard]] double area(std::size_t face) const { return diagram.face_areas[face] * scale * scale; }

  /// The faces of cell i are begin(i) .. end(i) - 1.
  [[nodiscard]] std::size_t begin(std::size_t i) const { return diagram.face_offsets[i]; }
  [[nodiscard]] std::size_t end(std::size_t i) const { return diagram.face_offsets[i + 1]; }
  [[nodiscard]] std::size_t faces(std::size_t i) const { return end(i) - begin(i); }
  [[nodiscard]] std::span<const std::uint32_t> ring(std::size_t face) const {
    const auto first = diagram.face_vertex_offsets[face];
    return std::span(diagram.face_vertices).subspan(first, diagram.face_vertex_offsets[face + 1] - first);
  }
  /// By what the neighbor of a face is moved; that of a wall is not.
  [[nodiscard]] Shift3 shift(std::size_t face) const {
    return period.repeats() ? diagram.neighbor_shifts[face] : Shift3{};
  }
  [[nodiscard]] Point3 image(std::size_t i, const Shift3& by) const { return site(i) + period.of(by); }
  /// The way from cell i's site to the neighbor of its face, no wall.
  [[nodiscard]] Vector3 way(std::size_t i, std::size_t face) const {
    const auto j = static_cast<std::size_t>(diagram.neighbors[face]);
    return scaled(sites[j] - sites[i]) + period.of(shift(face));
  }
  /// The face of cell i whose neighbor is that image of `neighbor`; none if there is no such.
  [[nodiscard]] std::optional<std::size_t> faceTo(std::size_t i, std::int64_t neighbor,
                                                  const Shift3& by) const;
  [[nodiscard]] Plane3 wall(std::int64_t neighbor) const;
  /// The plane of a face of cell i.
  [[nodiscard]] Plane3 plane(std::size_t i, std::size_t face) const;
  /// How far p lies beyond the bisector of site i with site j, moved by `by`.
  [[nodiscard]] double beyond(std::size_t i, std::size_t j, const Point3& p, const Shift3& by = {}) const;
  /// "site 3" or "site 3 moved by (0, -1, 0)".
  [[nodiscard]] std::string name(std::int64_t neighbor, const Shift3& by) const;

  /// How much heavier site i is than site j, scaled.
  [[nodiscard]] double heavier(std::size_t i, std::size_t j) const {
    return weighted ? (weights[i] - weights[j]) * scale * scale : 0;
  }
  /// How far ties, each shorter than 1e-6 of a reach, may move a vertex.
  [[nodiscard]] double ties() const { return weighted ? weighted_tie_slack : tie_slack; }
  /// How far ties and rounding may move a vertex of cell i.
  [[nodiscard]] double slack(std::size_t i) const;
  [[nodiscard]] bool inDomain(const Point3& p) const {
    return (period.along(0) || (p.x >= box.xmin && p.x <= box.xmax)) &&
           (period.along(1) || (p.y >= box.ymin && p.y <= box.ymax)) &&
           (period.along(2) || (p.z >= box.zmin && p.z <= box.zmax));
  }
  /// A place of the domain, by its parts of it along each axis or vector.
  [[nodiscard]] Point3 placeAt(const std::array<double, 3>& parts) const;
  /// p in the caller's units, for messages.
  [[nodiscard]] std::string text(const Point3& p) const;

  std::span<const Point3> sites;
  std::span<const double> weights;
  bool weighted;  ///< the weights are not all equal
  const Diagram3& diagram;
  Detail3 detail;
  int threads;
  double scale;
  Box3 box;            ///< the domain, scaled; of a lattice, around its vectors
  SpacePeriod period;  ///< scaled
  double volume_of_all;
  double shortest_side, largest;  ///< largest: absolute coordinate of the domain
  double flattest;                ///< the least width of the domain
};

/// Statuses, owners and the lengths of arrays: what the other checks rely on. Returns whether they can be
/// used.
bool checkSpaceArrays(const CheckedSpace& run, Broken& broken);

/// Volumes that add up; faces that both cells have; surfaces and volumes that follow from areas.
void checkSpaceMeasures(const CheckedSpace& run, Broken& broken);

/// Closed surfaces of convex polyhedra, whose vertices lie on the planes of their faces, and measures that
/// match them.
void checkPolyhedra(const CheckedSpace& run, Broken& broken);

/// No site is nearer to a cell's vertices and centroid than its own; places of the domain lie in the cell of
/// their nearest site.
void checkNearestInSpace(const CheckedSpace& run, Broken& broken);

}  // namespace vorpipe::core::checks
