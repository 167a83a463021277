/// The sequence of tries until a cell is certified, both for finding cells and for drawing them.
///
/// A device first clips a cell fast, then, if the cell overflows, with more room. With the grid it walks the
/// bins, tile by tile if the sites do not fit. With lists it gets twice as many neighbors for cells that
/// others might still cut. The judge (judge.h) finds the remaining cells and the crowded ones. It finds all
/// of them if a sample, or the number of crowded sites, shows that the device would try in vain.
#pragma once

#include <functional>
#include <optional>

#include "cells/candidates.h"
#include "cells/device_eligible.h"
#include "cells/flann_search.h"
#include "cells/judge.h"
#include "cells/sample.h"
#include "cells/uploader.h"

namespace vorpipe::core {

/// Inputs for finding cells; they all outlive the call.
struct SearchInput {
  Backend& backend;
  Judge& judge;  ///< of the same sites
  const SiteSet& sites;
  const SearchOptions& search;
  int threads;
  const Progress& progress;
};

class CellLadder {
 public:
  using Which = std::span<const std::uint32_t>;
  using Statuses = std::span<CellStatus>;
  /// Functions that ask the device about some cells and set one status for each: cells of a tile, by index in
  /// its sites, or of candidates. `overflow` requests more room, `unsecured` more candidates. Any other
  /// status except certified and empty leaves the cell to the judge.
  struct Ask {
    std::function<Result<void>(const Tile& tile, Which which, Effort effort, Statuses status)> by_grid;
    std::function<Result<void>(const Candidates& candidates, Effort effort, Statuses status)> by_lists;
  };

  /// `upload` gives the backend its sites. With fewer than `worth_fast` sites, all cells have more room from
  /// the start.
  CellLadder(const SearchInput& input, Upload& upload, std::size_t worth_fast);

  /// Limits the ladder to these cells: the device is asked about `inside` but not about `outside`. Call this
  /// before the first climb.
  void choose(Triage triage);
  /// Asks the device about the cells that suit it; in later calls, about those that it solved before. Returns
  /// the remaining cells, ascending. Errors: the device's; progress requested a stop.
  Result<std::vector<std::uint32_t>> climbDevice(const Ask& ask);
  /// Adds the remaining cells to `rows`, which hold all others.
  Result<void> findLeft(const std::vector<std::uint32_t>& which, NeighborRows& rows);
  /// Finds remaining cells if the others are unknown.
  Result<KnownCells> askJudge(std::vector<std::uint32_t> which);

  /// Adds to `report` how many cells took which path, and the times of the host search and the judge.
  void describe(Report& report) const;

  [[nodiscard]] double judgeSeconds() const { return judge_seconds_; }

 private:
  using Indices = std::vector<std::uint32_t>;
  /// Cells of a tile that need more room.
  struct Large {
    Indices cells;
    std::size_t overflowed = 0;  ///< how many of `cells` overflowed in this climb's fast try
  };
  /// Cells from lists that need another try.
  struct Outcome {
    Indices roomier, unsecured;
  };

  void sortOutOnce();

  Result<void> climbGrid(const Ask& ask);
  Result<void> tryTile(const Tile& tile, const Ask& ask);
  Result<void> tryFast(const Tile& tile, Which which, const Ask& ask, Large& large);
  Result<void> tryLarge(const Tile& tile, const Ask& ask, Large& large);
  Result<void> tryCells(const Tile& tile, Which which, Effort effort, const Ask& ask, Large& large);
  [[nodiscard]] bool areMany(std::size_t more) const;
  void leave(const Tile& tile, Which which);

  Result<void> climbLists(const Ask& ask);
  Result<Outcome> tryLists(Which which, std::size_t k, Effort effort, const Ask& ask);

  SearchInput input_;
  Upload& upload_;
  bool sorted_out_ = false;
  Indices on_device_;  ///< cells that the device is asked about, ascending
  Indices left_;       ///< indices in the whole set: cells neither certified nor worth another device try
  bool begins_roomy_;  ///< every cell has room from the start
  bool any_roomy_;     ///< any cell needed room before this climb
  std::vector<bool> roomy_;  ///< by site: needs more room than a fast try has
  std::size_t done_ = 0;     ///< cells of this climb, for the progress
  std::size_t hidden_ = 0;   ///< cells of the current tile that came out empty
  std::optional<FlannSearch> lists_;
  std::uint64_t retried_ = 0, in_double_ = 0, exact_ = 0;
  double search_seconds_ = 0, judge_seconds_ = 0;
};

}  // namespace vorpipe::core
