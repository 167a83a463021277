/// Cells as faces that share vertices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/base/byte_sink.h"
#include "vorpipe.h"

namespace vorpipe {

/// Faces without holes, since mesh formats support no others: one for each piece of a cell; a piece with
/// holes becomes triangles.
struct CellsMesh {
  std::vector<Point> points;           ///< each position once, in the order of first use by the faces
  std::vector<std::int32_t> corners;   ///< indices of points, counter-clockwise, face after face
  std::vector<std::uint64_t> offsets;  ///< size: faces + 1; where the corners of each face begin
  std::vector<std::uint32_t> sites;    ///< the site of each face, ascending
  std::vector<double> heights{};       ///< z of each point; empty in the plane
  [[nodiscard]] std::size_t size() const { return sites.size(); }
  [[nodiscard]] std::span<const std::int32_t> cornersOf(std::size_t face) const {
    return std::span(corners).subspan(offsets[face], offsets[face + 1] - offsets[face]);
  }
  [[nodiscard]] Point3 inSpace(std::size_t point) const {
    return {points[point].x, points[point].y, heights.empty() ? 0 : heights[point]};
  }
};

/// Joins vertices as distinctPoints() does. Errors: the cells have more vertices than the indices of mesh
/// formats, 32-bit and signed, can count (input); a piece with holes could not be cut into triangles
/// (device). The message names `sink`.
Result<CellsMesh> cellsMesh(const ByteSink& sink, const Diagram& diagram);

/// Cells on the globe as faces in space, with corners on the unit sphere. One that reaches farther than five
/// degrees from its centroid is in pieces of that size, so that faces are near to the sphere. In an
/// outline pieces that are larger, or have holes, are triangles. Errors: as above.
Result<CellsMesh> globeMesh(const ByteSink& sink, const Sites& sites, const Diagram& diagram);

/// Cells as triangles for a device, which has the diagram's vertices as they are: each belongs to one cell.
struct CellTriangles {
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< in Diagram::vertices, counter-clockwise, by cell
  std::vector<std::uint32_t> sites;                     ///< by vertex
};

/// Cuts each piece of a cell into a fan, or where that does not fill it, as GEOS does. Errors: more vertices
/// than 32 bits count, or cells on the globe (input); a piece could not be cut (device).
Result<CellTriangles> cellTriangles(const Diagram& diagram);

}  // namespace vorpipe
