/// Measures cells in tiles.
#pragma once

#include <optional>
#include <vector>

#include "cli/forecast.h"
#include "cli/input.h"
#include "io/cells/cells_file.h"
#include "io/sites/mapped_sites.h"
#include "vorpipe/tiled.h"

namespace vorpipe::cli {

/// Sites that are measured in tiles, without copying them.
struct TiledInput {
  Input input;  ///< if the sites are mapped, a few sites represent all
  std::optional<MappedSites> mapped;

  [[nodiscard]] SitesInPlace places() const { return mapped ? mapped->sites() : sitesInPlace(input.sites); }
};

/// Whether the options give sites without weights, in a box without periods.
bool canBeTiled(const InputOptions& options);

/// Maps the sites of a .npy file, or loads any others. Errors: those of loadInput and MappedSites::map.
Result<TiledInput> loadTiled(const InputOptions& options, int threads);

/// Measures in the order of the input.
struct Measured {
  explicit Measured(std::size_t sites);
  [[nodiscard]] MeasuresOfCells all() const { return {area, centroid, neighbors, status}; }

  std::vector<double> area;
  std::vector<Point> centroid;
  std::vector<std::uint32_t> neighbors;
  std::vector<Status> status;
};

/// Returns a sink that stores measures at their sites' indices, on several threads.
CellsSink sinkOf(Measured& measured, int threads);

}  // namespace vorpipe::cli
