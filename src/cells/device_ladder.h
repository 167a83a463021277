/// The sequence of tries until a cell is certified, both for finding cells and for drawing them.
///
/// A device first clips a cell fast, then, if the cell overflows, with more room. With the grid it walks the
/// bins, tile by tile if the sites do not fit. With lists it gets twice as many neighbors for cells that
/// others might still cut. The exact search (exact_search.h) finds the remaining cells and the crowded ones.
/// It finds all of them if a sample, or the number of crowded sites, shows that the device would try in vain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "cells/bisectors.h"
#include "cells/exact_search.h"
#include "cells/flann_search.h"
#include "sites/tiles.h"

namespace vorpipe::core {

/// Which cells a device is asked to find.
struct Triage {
  std::vector<std::uint32_t> inside;   ///< sites whose cells a device is asked to find, ascending
  std::vector<std::uint32_t> outside;  ///< the others, ascending; the exact search finds their cells
};

/// Gives a device the sites inside the domain. A site outside may be so far from its cell that a float cannot
/// decide whether the domain contains a little of it. Gives it none if squares of distances or weights may
/// not fit in a float: a site 1e15 domains away, or a weight of 1e18 squared domains, affects the search for
/// any cell.
Triage sortOut(const SiteSet& sites, int threads);

/// Whether a device still holds all sites of a set, with their colors, from one run to the next.
struct HeldSites {
  /// Number of uploads to the device in use, by this or by others; null if unknown.
  const std::uint64_t* uploads = nullptr;
  std::optional<std::uint64_t> after{};  ///< that number just after these sites were uploaded

  [[nodiscard]] bool areThere() const { return uploads != nullptr && after == *uploads; }
};

/// Gives a device its sites, if it does not hold them yet.
class Upload {
 public:
  /// `palette_index` is by index in the set; empty when nothing will be drawn. `held` outlives this; without
  /// it, the device counts as holding nothing before and afterwards.
  Upload(Backend& backend, std::span<const std::uint8_t> palette_index, HeldSites* held = nullptr)
      : backend_(backend), palette_index_(palette_index), held_(held) {}

  /// Gives the device a tile's sites. All sites are given once; they stay until a tile replaces them.
  Result<void> give(const Tile& tile);

  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  Backend& backend_;
  std::span<const std::uint8_t> palette_index_;
  HeldSites* held_;
  std::vector<std::uint8_t> tile_palette_index_;
  bool has_all_ = false;
  double seconds_ = 0;
};

/// Cells tried first, to predict how a device does on the others.
struct Sample {
  std::vector<std::uint32_t> cells, rest;  ///< both ascending; together they are `which`

  /// All of `which`, if it is too short to be worth a sample; else some hundred, evenly spread.
  explicit Sample(std::span<const std::uint32_t> which) {
    constexpr std::size_t size = 128, least = 8 * size;
    const auto step = which.size() < least ? 1 : which.size() / size;
    cells.reserve(which.size() / step + 1);
    rest.reserve(which.size() - which.size() / step);
    for (std::size_t begin = 0; begin < which.size(); begin += step) {
      const auto some = which.subspan(begin, std::min(step, which.size() - begin));
      cells.push_back(some.front());
      rest.insert(rest.end(), some.begin() + 1, some.end());
    }
  }

  /// Estimates, rather too low, how many of the rest will fail if `failed` of the sample did.
  [[nodiscard]] std::size_t expected(std::size_t failed) const {
    return failed * rest.size() / cells.size() / 2;
  }

  /// Whether so few of the rest will succeed that the exact search finds all of them sooner than a device
  /// tries them.
  [[nodiscard]] bool isHopeless(std::size_t failed) const { return 4 * failed > 3 * cells.size(); }

  /// Whether weights hide so many sites, given `hidden` in the sample, that triangulating all sites is
  /// faster. A triangulation drops a hidden site at once; a device must look far around it for a heavier one.
  [[nodiscard]] bool areMostlyHidden(std::size_t hidden) const { return 3 * hidden > cells.size(); }
};

/// Inputs for finding cells; they all outlive the call.
struct SearchInput {
  Backend& backend;
  ExactSearch& exact_search;  ///< of the same sites
  const SiteSet& sites;
  const SearchOptions& search;
  int threads;
  const Progress& progress;
};

/// The cells of some sites; entry e of `found`, certified or empty, is the cell of which[e].
struct CellResults {
  std::vector<std::uint32_t> which;
  NeighborRows found;
};

class CellLadder {
 public:
  using Which = std::span<const std::uint32_t>;
  using Statuses = std::span<CellStatus>;
  /// Functions that ask the device about some cells and set one status for each: cells of a tile, by index in
  /// its sites, or of candidates. `overflow` requests more room, `unsecured` more candidates. Any other
  /// status except certified and empty leaves the cell to the exact search.
  struct Ask {
    std::function<Result<void>(const Tile& tile, Which which, Capacity capacity, Statuses status)> by_grid;
    std::function<Result<void>(const Candidates& candidates, Capacity capacity, Statuses status)> by_lists;
  };

  /// `upload` gives the backend its sites. With fewer than `worth_fast` sites, all cells have more room from
  /// the start.
  CellLadder(const SearchInput& input, Upload& upload, std::size_t worth_fast);

  /// Limits the ladder to these cells: the device is asked about `inside` but not about `outside`. Call this
  /// before the first run.
  void choose(Triage triage);
  /// Asks the device about the cells that suit it; in later calls, about those that it solved before. Returns
  /// the remaining cells, ascending. Errors: the device's; progress requested a stop.
  Result<std::vector<std::uint32_t>> run(const Ask& ask);
  /// Adds the remaining cells to `rows`, which hold all others.
  Result<void> findLeft(const std::vector<std::uint32_t>& which, NeighborRows& rows);
  /// Finds remaining cells if the others are unknown.
  Result<CellResults> askExactSearch(std::vector<std::uint32_t> which);

  /// Adds to `report` how many cells took which path, and the times of the host search and the exact search.
  void describe(Report& report) const;

  [[nodiscard]] double judgeSeconds() const { return judge_seconds_; }

 private:
  using Indices = std::vector<std::uint32_t>;
  /// Cells of a tile that need more room.
  struct Large {
    Indices cells;
    std::size_t overflowed = 0;  ///< how many of `cells` overflowed in this run's fast try
  };
  /// Cells from lists that need another try.
  struct Outcome {
    Indices overflowed, unsecured;
  };

  Result<void> runGrid(const Ask& ask);
  Result<void> tryTile(const Tile& tile, const Ask& ask);
  Result<void> tryFast(const Tile& tile, Which which, const Ask& ask, Large& large);
  Result<void> retryLarge(const Tile& tile, const Ask& ask, Large& large);
  Result<void> tryCells(const Tile& tile, Which which, Capacity capacity, const Ask& ask, Large& large);
  [[nodiscard]] bool areMany(std::size_t more) const;
  void defer(const Tile& tile, Which which);

  Result<void> runLists(const Ask& ask);
  Result<Outcome> tryLists(Which which, std::size_t k, Capacity capacity, const Ask& ask);

  SearchInput input_;
  Upload& upload_;
  bool sorted_out_ = false;
  Indices on_device_;  ///< cells that the device is asked about, ascending
  Indices left_;       ///< indices in the whole set: cells neither certified nor worth another device try
  bool begins_large_;  ///< every cell has room from the start
  bool any_large_;     ///< any cell needed room before this run
  std::vector<bool> large_;  ///< by site: needs more room than a fast try has
  std::size_t done_ = 0;     ///< cells of this run, for the progress
  std::size_t hidden_ = 0;   ///< cells of the current tile that came out empty
  std::optional<FlannSearch> lists_;
  std::uint64_t retried_ = 0, in_double_ = 0, exact_ = 0;
  double search_seconds_ = 0, judge_seconds_ = 0;
};

}  // namespace vorpipe::core
