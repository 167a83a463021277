#include "cells/neighbor_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "backend/collect.h"
#include "base/inside.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/answers.h"
#include "cells/bisectors.h"
#include "cells/hidden_cells.h"

namespace vorpipe::core {
namespace {

/// The largest distance by which a bisector of a site with its next few sites, before or after it, lies
/// behind the site.
double depthOf(const SiteSet& sites, std::size_t i) {
  constexpr std::size_t few = 2;
  double deepest = -std::numeric_limits<double>::infinity();
  const auto last = std::min(i + few, sites.size() - 1);
  for (auto j = i > few ? i - few : 0; j <= last; ++j) {
    if (j == i) continue;
    const double dx = sites.x[j] - sites.x[i], dy = sites.y[j] - sites.y[i];
    const double squared = dx * dx + dy * dy;
    deepest = std::max(deepest, (sites.weight[j] - sites.weight[i] - squared) / std::sqrt(squared));
  }
  return deepest;
}

/// Sites that may have no cell, to be checked before all others: some hundred sites inside the domain,
/// ascending; none without weights. Consecutive sites in the set are near each other. From each run of them,
/// takes the site whose bisector with one of the next few sites lies farthest behind it.
std::vector<std::uint32_t> likelyEmpty(const SiteSet& sites, int threads) {
  constexpr std::size_t runs = 512;
  if (sites.weight.empty()) return {};
  const std::size_t length = (sites.size() + runs - 1) / runs;
  std::vector<std::uint32_t> likely((sites.size() + length - 1) / length);
  std::vector<double> depth(likely.size(), -std::numeric_limits<double>::infinity());
  parallelFor(sites.size(), length, threadsForSteps(sites.size(), threads),
              [&](std::size_t begin, std::size_t end) {
                const auto run = begin / length;
                for (auto i = begin; i < end; ++i) {
                  if (!isInside(sites.domain, sites.x[i], sites.y[i])) continue;
                  const double deep = depthOf(sites, i);
                  if (!(deep > depth[run])) continue;
                  depth[run] = deep;
                  likely[run] = static_cast<std::uint32_t>(i);
                }
              });
  std::size_t count = 0;
  for (std::size_t run = 0; run < likely.size(); ++run) {
    if (depth[run] > 0) likely[count++] = likely[run];
  }
  likely.resize(count);
  return likely;
}

/// Whether sites were rounded to a lattice so coarse that some coincide. Floats decide ties cell by cell;
/// where only some are ties, most of these decisions are disputed afterwards.
bool areSnapped(const SiteSet& sites) {
  constexpr std::size_t few = 200;
  const std::size_t given = *std::ranges::max_element(sites.id) + std::size_t{1};
  return few * (given - sites.size()) > given;
}

/// Asks the device, and keeps the cells that it finds.
class DeviceSearch {
 public:
  DeviceSearch(const SearchInput& input, AtEmpty at_empty, NeighborRows& rows)
      : input_(input), may_end_(at_empty == AtEmpty::end && !input.sites.weight.empty()), rows_(rows) {}

  /// Whether the functions below returned an error because a site has no cell.
  [[nodiscard]] bool ended() const { return ended_; }

  Result<void> byGrid(const Tile& tile, std::span<const std::uint32_t> which, Capacity capacity,
                      std::span<CellStatus> status) {
    VORPIPE_TRY(tryLikelyEmpty(tile));
    CellNeighbors found;
    VORPIPE_TRY(askCells(input_.backend, tile.sites.size(), which, capacity, input_.threads, found));
    std::ranges::copy(found.status, status.begin());
    std::vector<std::uint32_t> whole;
    if (!tile.whole.empty()) {
      for (const auto site : which) whole.push_back(tile.whole[site]);
      parallelFor(which.size(), grain, input_.threads, [&](std::size_t begin, std::size_t end) {
        for (auto e = begin; e < end; ++e) {
          renumber(found, e, [&](std::uint32_t site) { return tile.whole[site]; });
        }
      });
      which = whole;
    }
    VORPIPE_TRY(endIfEmpty(which, found));
    rows_.add(which, std::move(found));
    return {};
  }

  /// Clips cells by lists of `candidates`, always with the large capacity. The neighbors found are positions
  /// in these lists; it converts them to sites.
  Result<void> byLists(const Candidates& candidates, std::span<CellStatus> status) {
    const Stopwatch watch;
    packBatch(input_.sites, candidates, 0, candidates.site.size(), input_.threads, batch_);
    pack_seconds_ += watch.seconds();
    CellNeighbors found;
    VORPIPE_TRY(askCells(input_.backend, batch_, input_.threads, found));
    // No larger room is available.
    std::ranges::replace_copy(found.status, status.begin(), CellStatus::overflow, CellStatus::open);
    for (std::size_t e = 0; e < candidates.site.size(); ++e) {
      renumber(found, e, [&](std::uint32_t line) { return candidates.index[candidates.offsets[e] + line]; });
    }
    rows_.add(candidates.site, std::move(found));
    return {};
  }

  [[nodiscard]] double packSeconds() const { return pack_seconds_; }

 private:
  static constexpr std::size_t grain = std::size_t{1} << 16;

  /// Tries likely empty cells before all others, if all sites are one tile: this finds a site without a cell
  /// early.
  Result<void> tryLikelyEmpty(const Tile& tile) {
    if (!may_end_ || has_tried_ || !tile.whole.empty()) return {};
    has_tried_ = true;
    const auto likely = likelyEmpty(input_.sites, input_.threads);
    if (likely.empty()) return {};
    CellNeighbors found;
    VORPIPE_TRY(askCells(input_.backend, tile.sites.size(), likely, Capacity::small, input_.threads, found));
    return endIfEmpty(likely, found);
  }

  /// Error: the answers about `which` prove that one of them has no cell.
  Result<void> endIfEmpty(std::span<const std::uint32_t> which, const CellNeighbors& found) {
    if (!may_end_) return {};
    for (std::size_t e = 0; e < which.size(); ++e) {
      if (found.status[e] != CellStatus::empty) continue;
      const auto lines =
          std::span(found.neighbor).subspan(found.offsets[e], found.offsets[e + 1] - found.offsets[e]);
      ended_ = leaveNothing(input_.sites, which[e], lines);
      if (ended_) return tl::unexpected(Error{ErrorCode::cancelled, "a site has no cell"});
    }
    return {};
  }

  const SearchInput& input_;
  bool may_end_, has_tried_ = false, ended_ = false;
  NeighborRows& rows_;
  CellBatch<double> batch_;
  double pack_seconds_ = 0;
};

/// Whether AtEmpty::end ends with these rows.
bool hasEmpty(const NeighborRows& rows) {
  for (std::size_t cell = 0; cell < rows.size(); ++cell) {
    if (rows.status(cell) == CellStatus::empty) return true;
  }
  return false;
}

}  // namespace

Result<std::optional<NeighborRows>> findNeighbors(const SearchInput& input, AtEmpty at_empty,
                                                  Report& report) {
  NeighborRows rows(input.sites.size(), input.threads);
  Upload upload(input.backend, {});
  CellLadder ladder(input, upload, 0);
  DeviceSearch device(input, at_empty, rows);
  if (input.sites.weight.empty() && areSnapped(input.sites)) ladder.choose({{}, allOf(input.sites)});
  const auto left = ladder.run({[&](const Tile& tile, auto which, Capacity capacity, auto status) {
                                  return device.byGrid(tile, which, capacity, status);
                                },
                                [&](const Candidates& candidates, Capacity, auto status) {
                                  return device.byLists(candidates, status);
                                }});
  if (device.ended()) return std::nullopt;
  if (!left) return tl::unexpected(left.error());
  VORPIPE_TRY(ladder.findLeft(*left, rows));
  ladder.describe(report);
  if (input.search.method == Search::grid) {
    report.time_ms.upload = 1e3 * upload.seconds();
  } else if (report.time_ms.search >= 0) {
    report.time_ms.search += 1e3 * device.packSeconds();
  }
  if (input.sites.weight.empty()) return rows;
  proveEmpty(input.sites, allOf(input.sites), input.threads, rows);
  if (at_empty == AtEmpty::end && hasEmpty(rows)) return std::nullopt;
  return rows;
}

Result<void> findAgain(const SearchInput& input, const std::vector<std::uint32_t>& which, Precision precision,
                       NeighborRows& rows) {
  std::uint64_t exact = 0;
  VORPIPE_VAR(found, input.exact_search.find(which, precision, input.threads, input.progress, exact));
  rows.add(which, std::move(found));
  proveEmpty(input.sites, which, input.threads, rows);
  return {};
}

bool findAllInMesh(const SearchInput& input, NeighborRows& rows) {
  const auto all = allOf(input.sites);
  if (!input.exact_search.findAmong(all, input.threads, rows)) return false;
  proveEmpty(input.sites, all, input.threads, rows);
  return true;
}

}  // namespace vorpipe::core
