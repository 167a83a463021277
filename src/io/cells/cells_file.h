/// Writes cells as a file of any known kind.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// Cells, and further contents of their records.
struct CellsOutput {
  const Sites& sites;
  const Diagram& diagram;
  std::span<const Attribute> attributes{};  ///< each as long as the sites
  CoordinateSystem system{};                ///< of all positions
  bool only_cells = false;                  ///< in formats of features: leaves out records without a polygon
  int threads = 0;                          ///< that format text; 0 for all
  const Attribute* names = nullptr;  ///< of sites, in place of their numbers among neighbors and as owners
  bool share = false;                ///< adds each cell's part of the area of all
};

/// A kind of file for cells. Each has a writer in cells_writers.h, and a line in cells_file.cpp.
struct CellsFormat {
  std::string_view extension;
  Detail detail;  ///< the parts of a Diagram that it writes
  /// The errors are those of writeCells.
  Result<void> (*write)(ByteSink& sink, const CellsOutput& output);
  bool mesh = false;        ///< whether it consists of faces that share vertices, which takes memory
  bool attributes = false;  ///< whether it contains those of the input
  bool features = false;    ///< whether it can leave out records without a polygon, for `only_cells`
  bool in_memory = false;   ///< whether the whole file is in memory before it is written
};

/// The extensions of all kinds, in the order in which messages name them.
std::vector<std::string_view> cellsExtensions();

/// The format that the path's extension names; never null. Error (input): it names none.
Result<const CellsFormat*> cellsFormatOf(const std::string& path);

/// Writes cells with the format's detail or more, in input order; equal cells give equal bytes. Numbers in
/// text read back to the same double, except in .svg, which is in pixels. Errors: .obj, .ply or .vtk with
/// more vertices than its indices can count (input); writing failed or memory ran out (device).
Result<void> writeCells(ByteSink& sink, const CellsOutput& output, const CellsFormat& format);

/// Measures of cells that need no edges, each by site.
struct MeasuresOfCells {
  std::span<const double> area;
  std::span<const Point> centroid;
  std::span<const std::uint32_t> neighbors;  ///< how many
  std::span<const Status> status;
};

/// Writes an .npz file with arrays of N sites: areas (N) and centroids (N, 2), float64; neighbor_counts
/// uint32 (N); status uint8 (N) with 0 ok, 1 empty, 2 duplicate. Errors: those of writeZip.
Result<void> writeMeasures(ByteSink& sink, const MeasuresOfCells& measures);

/// The same for a diagram. Its extension is .npz, which also names another format.
extern const CellsFormat npz_measures;

}  // namespace vorpipe
