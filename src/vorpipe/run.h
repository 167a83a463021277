/// What all runs have in common.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vorpipe {

/// Outcome for a site.
enum class Status : std::uint8_t {
  ok,         ///< it has a cell inside the domain, certified
  empty,      ///< certified: no part of the domain is nearest to it; it lies outside, or others hide it
  duplicate,  ///< another site has the same position and owns the cell: the heaviest, then the earliest
};

/// How the sites that may cut a cell are found.
enum class Search : std::uint8_t {
  grid,   ///< a walk over a uniform grid, fused with the clipping; no fixed number of neighbors
  flann,  ///< the k nearest neighbors by FLANN, doubled for the cells that k does not certify
};

struct SearchOptions {
  Search method = Search::grid;
  int neighbors = 30;  ///< FLANN's k, 3 to 1024
};

/// Called from the calling thread with a stage's name and the part done in [0, 1];
/// returning false stops the run with ErrorCode::cancelled.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Wall time by stage in milliseconds; negative where a stage does not apply.
struct Times {
  double order = -1, upload = -1, search = -1, cells = -1, draw = -1, download = -1;
};

/// A pipeline of shaders, and how long the device's driver took to make it.
struct PipelineTime {
  std::string name;  ///< of the module that does the work, as in "neighbors_grid_fast"
  double milliseconds = 0;
};

/// What a run did, for --stats.
struct Report {
  std::string backend, device, driver;
  std::uint64_t ok = 0, empty = 0, duplicate = 0;  ///< sites with that Status
  /// With different weights: number of sites that are nearest to no place in the domain's box, because others
  /// hide them. They count as empty, too; the outline removes the cells of the other empty sites.
  std::uint64_t hidden = 0;
  /// Number of times that cells were recomputed: on the device with more neighbors or more room; in double on
  /// the host; in exact arithmetic. A cell may count several times, and images of a periodic domain have
  /// cells of their own.
  std::uint64_t retried = 0, in_double = 0, exact = 0;
  /// Pixels that no cell of the device covered; they got their nearest site in double.
  std::uint64_t pixels = 0;
  Times time_ms;
  std::vector<PipelineTime> pipelines;  ///< those that this run was the first to need, in order of creation
  /// Changes during the run, one line each: a device refused memory and got smaller parts; or it failed, and
  /// the next one took over. `backend` and `device` are those that produced the result.
  std::vector<std::string> notes;
  std::vector<std::string> validation_messages;  ///< empty unless validation was on and reported something
};

}  // namespace vorpipe
