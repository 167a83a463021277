/// Cells that are measured in tiles.
#pragma once

#include <optional>
#include <vector>

#include "cli/forecast.h"
#include "cli/input.h"
#include "io/cells/measures_npz.h"
#include "io/sites/mapped_sites.h"
#include "vorpipe/tiled.h"

namespace vorpipe::cli {

/// Sites that are measured in tiles, where they are.
struct TiledInput {
  Input input;  ///< where they are mapped, with a few sites for all
  std::optional<MappedSites> mapped;

  [[nodiscard]] SitesInPlace places() const { return mapped ? mapped->sites() : sitesInPlace(input.sites); }
};

/// Whether the options leave sites without weights, in a box that does not repeat itself.
bool canBeTiled(const InputOptions& options);

/// Maps the sites of a .npy file, or loads any others. Errors: those of loadInput and MappedSites::map.
Result<TiledInput> loadTiled(const InputOptions& options, int threads);

/// Results in the order of the input.
struct Measured {
  explicit Measured(std::size_t sites);
  [[nodiscard]] MeasuresOfCells all() const { return {area, centroid, neighbors, status}; }

  std::vector<double> area;
  std::vector<Point> centroid;
  std::vector<std::uint32_t> neighbors;
  std::vector<Status> status;
};

/// Puts measures where their sites' are, on several threads.
CellsSink sinkOf(Measured& measured, int threads);

}  // namespace vorpipe::cli
