/// Inserts points into a triangulation, anywhere or in a region that one thread has to itself.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/predicates.h"

namespace vorpipe::core {

/// Regions are numbered from 0; a triangle belongs to a region if all of its corners except the ghost do.
using Region = std::uint8_t;
inline constexpr Region of_several = 254;  ///< of a triangle: its corners are in different regions
inline constexpr Region everywhere = 255;  ///< of an Insertion: it may change all triangles

/// A triangulation of those points that have been inserted.
struct GrowingMesh {
  const std::vector<Point>& points;
  const std::vector<double>& weights;      ///< empty, or by point
  BigVector<MeshTriangle> triangles;       ///< unused ones have the ghost for all corners
  BigVector<Region> region_of_point;       ///< for insertions into regions
  BigVector<Region> region;                ///< by triangle, for the same
  std::vector<std::uint8_t> is_in_cavity;  ///< by triangle, with weights; see Insertion
  std::vector<std::int32_t> near;          ///< by point: a triangle beside it at its insertion, or none

  static constexpr std::int32_t none = -1;
  static bool isUnused(const MeshTriangle& t) { return (t.corner[0] & t.corner[1] & t.corner[2]) < 0; }
};

/// Inserts points. Several threads may work on one mesh, each in a region of its own: an insertion reads and
/// writes triangles of its region, and only reads those of several regions, which are constant meanwhile.
///
/// A point replaces the triangles of its cavity. The cavity has no corner in its interior, so its adjacency
/// across edges is a tree. A walk over this tree needs no marks and meets the edges of the cavity's rim in
/// their order. With weights there may be interior corners, which become hidden. Then triangles are marked,
/// and the walk follows a spanning tree.
class Insertion {
 public:
  /// `start` is a triangle where the first walk begins, or none.
  Insertion(GrowingMesh& mesh, Region region, std::int32_t start);

  /// Inserts a point. Up to two new triangles take the slots `room` and `room` + 1; a slot that is not needed
  /// becomes unused. Returns false and leaves the mesh unchanged if the cavity leaves the region.
  bool insert(std::int32_t point, std::int32_t room);

  /// Returns a triangle that contains point i; outside the hull, one that conflicts with it. Returns `none`
  /// if the walk leaves the region.
  std::int32_t locate(std::int32_t i);

  /// Points that were found hidden, or were hidden by others.
  std::vector<std::int32_t> hidden;

 private:
  /// An edge of the cavity, and the triangle behind it, whose neighbor `back` is in the cavity.
  struct RimEdge {
    std::int32_t from, to, outer;
    std::uint32_t back;
  };
  /// A triangle of the cavity, and which of its edges are still to be visited.
  struct Step {
    std::int32_t triangle;
    std::uint8_t edge, left;
  };
  [[nodiscard]] Point at(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] WeightedPoint weightedPoint(std::int32_t i) const;
  [[nodiscard]] bool mayChange(std::int32_t t) const;
  [[nodiscard]] bool mayLookAt(std::int32_t t) const;
  MeshTriangle& triangle(std::int32_t t) { return triangles_[static_cast<std::size_t>(t)]; }
  std::uint8_t& isInCavity(std::int32_t t) { return mesh_.is_in_cavity[static_cast<std::size_t>(t)]; }
  bool conflicts(const MeshTriangle& t, std::int32_t i);
  template <bool weighted>
  bool conflictsAny(const MeshTriangle& t, std::int32_t i, Point p);
  bool conflictsBeyondHull(const MeshTriangle& t, std::int32_t i);
  bool conflictsOnLine(std::int32_t a, std::int32_t b, std::int32_t i);
  std::int32_t nearby(std::int32_t i);
  std::int32_t neighborTowards(Point p, std::int32_t t, std::int32_t from);
  template <bool weighted>
  bool findCavity(std::int32_t i, std::int32_t first);
  void hideCorners();
  void fill(std::int32_t p, std::int32_t room);
  void leaveEmpty(std::int32_t t) { triangle(t).corner = {ghost, ghost, ghost}; }

  GrowingMesh& mesh_;
  const Point* points_;
  MeshTriangle* triangles_;
  const Region region_;
  const bool is_weighted_;
  std::vector<std::int32_t> cavity_;
  std::vector<RimEdge> rim_;
  std::vector<Step> steps_;
  std::vector<std::int32_t> corners_;  ///< of the cavity, if one becomes hidden
  std::int32_t last_;                  ///< the newest triangle, or where a walk begins; or none
};

}  // namespace vorpipe::core
