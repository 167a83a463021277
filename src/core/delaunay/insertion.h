/// Points inserted into a triangulation, anywhere or in a region that one thread has to itself.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/delaunay/mesh.h"
#include "core/geometry/predicates.h"

namespace vorpipe::core {

/// Regions are numbered from 0; a triangle belongs to a region if all of its corners but the ghost do.
using Region = std::uint8_t;
inline constexpr Region of_several = 254;  ///< of a triangle: its corners are in different regions
inline constexpr Region anywhere = 255;    ///< of an Insertion: it may change all triangles

/// A triangulation of those points that have been inserted.
struct GrowingMesh {
  const std::vector<Point>& points;
  const std::vector<double>& weights;      ///< empty, or by point
  BigVector<MeshTriangle> triangles;       ///< unused ones have the ghost for all corners
  BigVector<Region> region;                ///< by triangle; read only by insertions into regions
  std::vector<std::uint8_t> is_in_cavity;  ///< by triangle
  std::vector<std::int32_t> incident;      ///< by point: a triangle there, or `none`

  static constexpr std::int32_t none = -1;
};

/// Inserts points. Several threads may work on one mesh, each in a region of its own: an insertion reads and
/// writes triangles of its region, and only reads those of several, which are constant meanwhile.
class Insertion {
 public:
  /// Into a region whose points begin with `first`; after the last of all points may come the very first.
  Insertion(GrowingMesh& mesh, Region region, std::int32_t first);

  /// Into the whole mesh; `start` is a triangle where the first walk begins.
  Insertion(GrowingMesh& mesh, std::int32_t start);

  /// Inserts a point. Up to two new triangles take the slots `room` and `room` + 1; a slot that is not needed
  /// becomes unused. False, and the mesh is unchanged, where the cavity leaves the region.
  bool insert(std::int32_t point, std::int32_t room);

  /// A triangle with point i in it; outside the hull, one that conflicts with it. `none` where the walk
  /// leaves the region.
  std::int32_t locate(std::int32_t i);

  /// Points that were found hidden, or were hidden by others.
  std::vector<std::int32_t> hidden;

 private:
  struct RimEdge {
    std::int32_t from, to, outer;  ///< and the triangle behind it; in the end, the one before it
  };
  [[nodiscard]] Point at(std::int32_t i) const { return mesh_.points[static_cast<std::size_t>(i)]; }
  [[nodiscard]] WeightedPoint weighted(std::int32_t i) const;
  [[nodiscard]] bool mayChange(std::int32_t t) const;
  [[nodiscard]] bool mayLookAt(std::int32_t t) const;
  MeshTriangle& triangle(std::int32_t t) { return mesh_.triangles[static_cast<std::size_t>(t)]; }
  std::uint8_t& isInCavity(std::int32_t t) { return mesh_.is_in_cavity[static_cast<std::size_t>(t)]; }
  std::int32_t& incident(std::int32_t corner) {
    return corner == ghost ? incident_to_ghost_ : mesh_.incident[static_cast<std::size_t>(corner)];
  }
  bool conflicts(std::int32_t t, std::int32_t i);
  bool conflictsOnLine(std::int32_t a, std::int32_t b, std::int32_t i);
  std::int32_t nearby(std::int32_t i);
  std::int32_t neighborTowards(Point p, std::int32_t t, std::int32_t from);
  bool findCavity(std::int32_t i, std::int32_t first);
  void noteCorners();
  void hideCorners();
  void fill(std::int32_t p, std::int32_t room);
  void leaveEmpty(std::int32_t t) { triangle(t).corner = {ghost, ghost, ghost}; }

  GrowingMesh& mesh_;
  Region region_;
  std::int32_t first_;  ///< of the region's points
  std::vector<std::int32_t> cavity_;
  std::vector<RimEdge> rim_;
  std::vector<std::int32_t> corners_;  ///< of the cavity, where a corner may become hidden
  std::int32_t incident_to_ghost_ = GrowingMesh::none;
  std::int32_t last_;  ///< the newest triangle, or where a walk begins; or none
};

}  // namespace vorpipe::core
