/// Writes areas, centroids and neighbor counts of cells as an archive of NumPy arrays.
#pragma once

#include <cstdint>
#include <span>

#include "io/base/byte_sink.h"
#include "io/cells/cells_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// Measures of cells that need no edges, each by site.
struct MeasuresOfCells {
  std::span<const double> area;
  std::span<const Point> centroid;
  std::span<const std::uint32_t> neighbors;  ///< how many
  std::span<const Status> status;
};

/// Writes arrays of N sites: areas (N) and centroids (N, 2), float64; neighbor_counts uint32 (N); status
/// uint8 (N) with 0 ok, 1 empty, 2 duplicate. Errors: those of writeZip.
Result<void> writeMeasures(ByteSink& sink, const MeasuresOfCells& measures);

/// The same for a diagram. Its extension is .npz, which also names another format.
extern const CellsFormat npz_measures;

}  // namespace vorpipe
