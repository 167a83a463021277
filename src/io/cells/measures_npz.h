/// Areas, centroids and numbers of neighbors of cells as an archive of NumPy's arrays.
#pragma once

#include <cstdint>
#include <span>

#include "io/base/byte_sink.h"
#include "io/cells/cells_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// What is known of cells without their edges, each by site.
struct MeasuresOfCells {
  std::span<const double> area;
  std::span<const Point> centroid;
  std::span<const std::uint32_t> neighbors;  ///< how many
  std::span<const Status> status;
};

/// Arrays of N sites: areas (N) and centroids (N, 2), float64; neighbor_counts uint32 (N); status uint8 (N)
/// with 0 ok, 1 empty, 2 duplicate. Errors: those of writeZip.
Result<void> writeMeasures(ByteSink& sink, const MeasuresOfCells& measures);

/// The same of a diagram; its extension is .npz, which names another format.
extern const CellsFormat npz_measures;

}  // namespace vorpipe
