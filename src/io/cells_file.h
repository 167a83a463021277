/// Cells as a file of any known kind.
#pragma once

#include <cstdint>
#include <string>

#include "io/output_file.h"
#include "vorpipe.h"

namespace vorpipe {

enum class CellsFormat : std::uint8_t {
  csv,      ///< a row for each site
  npz,      ///< NumPy arrays: everything that a Diagram holds
  geojson,  ///< a feature for each site; its geometry is null where it has no cell
  svg,      ///< a picture that says site and area where the pointer is
  obj,      ///< a mesh: each position once, a face for each piece of a cell
  ply,      ///< the same, binary, with site and area of each face
  vtk,      ///< the same for ParaView, with measures as cell data
  wkt,      ///< GEOMETRYCOLLECTION of a polygon for each site, EMPTY where it has no cell
};

/// The format that the path's extension names. Error (input): it names none.
Result<CellsFormat> cellsFormatOf(const std::string& path);

/// The parts of a Diagram that the format writes.
Detail detailOf(CellsFormat format);

/// Writes `diagram`, the cells of `sites` with detailOf(format) or more, in input order; equal cells give
/// equal bytes. Numbers in text read back to the same double, but for .svg, which is in pixels. Errors: .obj,
/// .ply or .vtk with more vertices than its indices can count (input); writing failed or memory ran out
/// (device).
Result<void> writeCells(OutputFile& file, const Sites& sites, const Diagram& diagram, CellsFormat format);

}  // namespace vorpipe
