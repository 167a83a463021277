/// Which try follows which until a cell is certified: for cells that are found and for cells that are drawn.
///
/// A device clips a cell fast; one that overflows, with more room. With the grid it walks the bins, tile by
/// tile where the sites do not fit; with lists it gets twice as many neighbors for cells that others might
/// still cut. What it leaves, and what is crowded, is the judge's (judge.h): all of it, where a sample or
/// the number of crowded sites tells that the device would try in vain.
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

/// What finding cells works with; all of it outlives the call.
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
  /// Ask the device about some cells, one status for each: of a tile, by index in its sites; or from
  /// candidates. `overflow` asks for more room, `unsecured` for more candidates; what else is neither
  /// certified nor empty is left to the judge.
  struct Ask {
    std::function<Result<void>(const Tile& tile, Which which, Effort effort, Statuses status)> by_grid;
    std::function<Result<void>(const Candidates& candidates, Effort effort, Statuses status)> by_lists;
  };

  /// `upload` gives the backend its sites. Fewer cells than `worth_fast` have room from the start.
  CellLadder(const SearchInput& input, Upload& upload, std::size_t worth_fast);

  /// Asks about these cells alone: `inside` are those that the device is asked about, `outside` the others.
  /// Comes before the first climb.
  void choose(Triage triage);
  /// Asks the device about the cells that it is fit for, in later calls about those that it did before.
  /// Returns the cells that are left, ascending. Errors: the device's; progress said stop.
  Result<std::vector<std::uint32_t>> climbDevice(const Ask& ask);
  /// Adds the cells that are left to `rows`, which have all others.
  Result<void> findLeft(const std::vector<std::uint32_t>& which, NeighborRows& rows);
  /// Finds cells that are left where the others are not known.
  Result<KnownCells> askJudge(std::vector<std::uint32_t> which);

  /// Adds how many cells took which way, and the times of searching on the host and of the judge.
  void describe(Report& report) const;

  [[nodiscard]] double judgeSeconds() const { return judge_seconds_; }

 private:
  using Indices = std::vector<std::uint32_t>;
  /// Cells of a tile that need more room.
  struct Large {
    Indices cells;
    std::size_t overflowed = 0;  ///< how many of `cells` overflowed in this climb's fast try
  };
  /// What became of cells from lists.
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
  Indices on_device_;        ///< what the device is asked about, ascending
  Indices left_;             ///< in the whole set: neither certified nor worth another try on the device
  bool begins_roomy_;        ///< every cell has room from the start
  bool any_roomy_;           ///< any of these, before this climb
  std::vector<bool> roomy_;  ///< by site: needs more room than a fast try has
  std::size_t done_ = 0;     ///< cells of this climb, for the progress
  std::size_t hidden_ = 0;   ///< of the cells that a tile was asked for, those that came out empty
  std::optional<FlannSearch> lists_;
  std::uint64_t retried_ = 0, in_double_ = 0, exact_ = 0;
  double search_seconds_ = 0, judge_seconds_ = 0;
};

}  // namespace vorpipe::core
