/// The Voronoi cells of places on a sphere.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "globe/direction.h"
#include "globe/sphere_centers.h"
#include "globe/sphere_mesh.h"

namespace vorpipe::core {

/// The cell of a site: edge k runs counter-clockwise from vertex k to the next along a great circle, between
/// the site and neighbor k, the lowest neighbor first. A sole edge is a whole great circle; without edges the
/// cell is the sphere.
struct SphereCell {
  std::size_t site;
  Direction direction;  ///< of the site
  std::span<const std::int64_t> neighbor;
  std::span<const Direction> vertex;  ///< the same bits in all cells that meet there
  std::span<const Point> place;       ///< of each vertex, in degrees, if wanted
};

/// The cells of a mesh's sites, made when they are visited: as an array their vertices would be the largest
/// of a run. Edges shorter than 1e-6 of their sites' distance, or than rounding, are in neither cell.
class SphereCells {
 public:
  /// Where the row of each site begins among the edges of all; size: sites + 1.
  std::vector<std::uint64_t> offsets;

  /// The number of steps of a visit.
  [[nodiscard]] std::size_t steps() const {
    return mesh_->circle.empty() ? mesh_->site.size() : mesh_->circle.size();
  }

  /// Calls work(cell) for each cell among steps begin to end - 1. Steps follow each other along a curve, as
  /// the cells do.
  void visit(std::size_t begin, std::size_t end, const std::function<void(const SphereCell&)>& work) const;

 private:
  friend class CellRows;
  SphereCells(const SphereSites& sites, const SphereMesh& mesh) : sites_(&sites), mesh_(&mesh) {}
  void visitMesh(std::size_t begin, std::size_t end,
                 const std::function<void(const SphereCell&)>& work) const;

  const SphereSites* sites_;
  const SphereMesh* mesh_;
  BigVector<Direction> along_;       ///< the directions of sites, by vertex of the mesh
  BigVector<SphereCenter> centers_;  ///< by triangle; those of ties' roots alone are valid
  std::vector<std::uint32_t> root_;  ///< by triangle: the lowest with the same center
  BigVector<Point> places_;          ///< by triangle, if wanted
  Direction axis_{};                 ///< of the circle on which all sites lie
};

/// Sites and mesh outlive the cells. Error (input): sites so near to each other that rounding leaves one
/// without edges.
Result<SphereCells> cellsOfSphere(const SphereSites& sites, const SphereMesh& mesh, bool has_places,
                                  int threads);

/// A part of a great circle, as of an edge.
struct GreatArc {
  Direction begin, end;
  Direction axis;  ///< unit vector around which the edge turns counter-clockwise
  double angle;    ///< in radians, up to a whole turn
};

/// Edge k of a cell; `sites` are the vectors of all.
GreatArc arcOf(std::span<const Direction> sites, const SphereCell& cell, std::size_t edge);
/// The edge of a site's cell to a neighbor between two vertices; between the same, if it is the sole edge.
GreatArc arcBetween(const Direction& site, const Direction& neighbor, const Direction& begin,
                    const Direction& end, bool is_sole);

/// The place of an arc at a fraction of its length.
Direction pointOn(const GreatArc& arc, double fraction);

/// The end of one of an arc's pieces: the same point in both cells that have the arc.
inline Direction pieceEnd(const GreatArc& arc, int piece, int pieces) {
  const bool is_forward = arc.begin == arc.end ? arc.axis < -arc.axis : arc.begin < arc.end;
  if (is_forward) return pointOn(arc, static_cast<double>(piece) / pieces);
  return pointOn({arc.end, arc.begin, -arc.axis, arc.angle}, static_cast<double>(pieces - piece) / pieces);
}

}  // namespace vorpipe::core
