/// The Voronoi cells of places on a sphere.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "globe/direction.h"
#include "globe/sphere_mesh.h"

namespace vorpipe::core {

/// Cells on the sphere, by site, in rows like those of a Diagram: edge k of a cell runs counter-clockwise
/// from its vertex k to the next along a great circle, between its site and neighbor k. A sole edge is a
/// whole great circle. Edges shorter than 1e-6 of their sites' distance, or than rounding, are in neither
/// cell.
struct SphereCells {
  std::vector<std::uint64_t> offsets;  ///< size: sites + 1
  std::vector<std::int64_t> neighbor;
  std::vector<Direction> vertex;  ///< the same bits in all cells that meet there
  std::vector<Point> place;       ///< of each vertex, in degrees, if wanted
};

/// Error (input): sites so near to each other that rounding leaves one without edges.
Result<SphereCells> cellsOfSphere(const SphereSites& sites, const SphereMesh& mesh, bool has_places,
                                  int threads);

/// A part of a great circle, as of an edge.
struct GreatArc {
  Direction begin, end;
  Direction axis;  ///< unit vector around which the edge turns counter-clockwise
  double angle;    ///< in radians, up to a whole turn
};

/// Edge k of a site's cell.
GreatArc arcOf(std::span<const Direction> sites, const SphereCells& cells, std::size_t site,
               std::uint64_t edge);
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
