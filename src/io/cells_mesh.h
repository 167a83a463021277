/// Cells as faces that share their vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/output_file.h"
#include "vorpipe.h"

namespace vorpipe {

struct CellsMesh {
  std::vector<Point> points;          ///< each position once, in the order in which the cells meet them
  std::vector<std::int32_t> corners;  ///< which point each of Diagram::vertices is
  std::vector<std::uint32_t> faces;   ///< the sites that have a polygon, ascending
  std::uint64_t face_corners = 0;     ///< of all faces together
};

/// Joins vertices whose coordinates are equal; none is moved. Error (input): the cells have more vertices
/// than the indices of mesh formats, 32-bit and signed, can count; `file` is named.
Result<CellsMesh> cellsMesh(const OutputFile& file, const Diagram& diagram);

/// The corners of a site's face.
inline std::span<const std::int32_t> cornersOf(const CellsMesh& mesh, const Diagram& diagram,
                                               std::size_t site) {
  const std::uint64_t begin = diagram.cell_offsets[site];
  return std::span(mesh.corners).subspan(begin, diagram.cell_offsets[site + 1] - begin);
}

}  // namespace vorpipe
