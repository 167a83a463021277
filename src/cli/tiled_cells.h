/// Measures cells in tiles, for `cells --detail measures`.
#pragma once

#include <cstddef>
#include <optional>

#include "cli/input.h"
#include "cli/run.h"
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

/// Maps the sites of a .npy file, or loads any others. Errors: those of forecastGenerated, loadInput and
/// MappedSites::map.
Result<TiledInput> loadTiled(const CommandRun& run, const InputOptions& options);

/// Measures the cells, and writes the measures to `files` files.
Result<ExitCode> measureInTiles(CommandRun& run, const InputOptions& options, const TiledInput& input,
                                std::size_t files);

}  // namespace vorpipe::cli
