#include "core/search/grid_search.h"

#include <utility>

#include "backend/collect.h"
#include "base/parallel.h"
#include "base/progress_steps.h"
#include "core/judge/answers.h"
#include "core/search/sample.h"
#include "core/search/uploader.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = std::size_t{1} << 16;

using Indices = std::vector<std::uint32_t>;

class Finding {
 public:
  Finding(const SearchInput& input, std::size_t cells, NeighborRows& rows, Report& report)
      : input_(input), cells_(cells), upload_(input.backend, {}), rows_(rows), report_(report) {}

  Result<void> findTile(const Tile& tile) {
    if (areMany(0)) {
      leave(tile, tile.own);
      return {};
    }
    if (auto given = upload_.give(tile); !given) return given;
    const Sample sample(tile.own);
    const auto before = left.size();
    Indices large;
    if (auto found = findFast(tile, sample.cells, large); !found) return found;
    // A few that need more room do not change what the sample tells.
    if (4 * large.size() > sample.cells.size()) {
      if (auto found = findLarge(tile, large); !found) return found;
    }
    const auto failed = left.size() - before;
    if (sample.isHopeless(failed) || areMany(sample.expected(failed))) {
      leave(tile, large);
      leave(tile, sample.rest);
      return {};
    }
    if (auto found = findFast(tile, sample.rest, large); !found) return found;
    return findLarge(tile, large);
  }

  /// Whether the cells that are left, with some more and those never asked for, are worth the mesh of all.
  [[nodiscard]] bool areMany(std::size_t more) const {
    return input_.judge.areMany(left.size() + more + (input_.sites.size() - cells_));
  }

  [[nodiscard]] double uploadSeconds() const { return upload_.seconds(); }

  Indices left;  ///< in the whole set; neither certified nor worth another try on the device

 private:
  Result<void> findFast(const Tile& tile, std::span<const std::uint32_t> which, Indices& large) {
    return find(tile, which, Effort::fast, "cells", large);
  }

  Result<void> findLarge(const Tile& tile, Indices& large) {
    const Indices which = std::exchange(large, {});
    report_.retried += which.size();
    return find(tile, which, Effort::roomy, "large cells", large);
  }

  /// What the mesh finds on the way.
  void leave(const Tile& tile, std::span<const std::uint32_t> which) {
    for (const auto site : which) left.push_back(tile.wholeIndex(site));
    done_ += which.size();
  }

  /// A fast try adds to `large` the cells that need more room.
  Result<void> find(const Tile& tile, std::span<const std::uint32_t> which, Effort effort, const char* stage,
                    Indices& large) {
    const auto before = large.size();
    const auto work = [&](std::size_t begin, std::size_t count) -> Result<void> {
      const auto part = which.subspan(begin, count);
      CellNeighbors found;
      if (auto done = askCells(input_.backend, tile.sites.size(), part, effort, input_.threads, found);
          !done) {
        return done;
      }
      for (std::size_t e = 0; e < count; ++e) {
        if (isDone(found.status[e])) continue;
        const bool again = effort == Effort::fast && found.status[e] == CellStatus::overflow;
        (again ? large : left).push_back(again ? part[e] : tile.wholeIndex(part[e]));
      }
      add(tile, part, std::move(found));
      return {};
    };
    const auto most = input_.backend.info().max_entries;
    const StageRange stretch{which.size(), done_, cells_};
    if (auto done = runInSteps(input_.progress, stage, stretch, most, work); !done) return done;
    done_ += which.size() - (large.size() - before);
    return {};
  }

  void add(const Tile& tile, std::span<const std::uint32_t> part, CellNeighbors found) {
    if (tile.whole.empty()) return rows_.add(part, std::move(found));
    Indices whole;
    for (const auto site : part) whole.push_back(tile.whole[site]);
    parallelFor(part.size(), grain, input_.threads, [&](std::size_t begin, std::size_t end) {
      for (auto e = begin; e < end; ++e) {
        renumber(found, e, [&](std::uint32_t site) { return tile.whole[site]; });
      }
    });
    rows_.add(whole, std::move(found));
  }

  const SearchInput& input_;
  std::size_t cells_;  ///< of all tiles
  std::size_t done_ = 0;
  Upload upload_;
  NeighborRows& rows_;
  Report& report_;
};

}  // namespace

Result<Indices> findByGrid(const SearchInput& input, std::span<const std::uint32_t> which, NeighborRows& rows,
                           Report& report) {
  Finding finding(input, which.size(), rows, report);
  auto unfit = forTiles(
      input.sites, input.backend.info(), which, input.threads,
      [&](const Tile& tile) { return finding.findTile(tile); }, [&] { return finding.areMany(0); });
  if (!unfit) return unfit;
  report.time_ms.upload = 1e3 * finding.uploadSeconds();
  finding.left.insert(finding.left.end(), unfit->begin(), unfit->end());
  return std::move(finding.left);
}

}  // namespace vorpipe::core
