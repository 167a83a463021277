#include "core/search/neighbor_search.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "backend/collect.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "core/judge/answers.h"
#include "core/judge/hidden_cells.h"
#include "core/search/bisectors.h"

namespace vorpipe::core {

Result<void> findAgain(const SearchInput& input, const std::vector<std::uint32_t>& which, Precision precision,
                       NeighborRows& rows) {
  std::uint64_t exact = 0;
  auto found = input.judge.find(which, precision, input.threads, input.progress, exact);
  if (!found) return tl::unexpected(found.error());
  rows.add(which, std::move(*found));
  proveEmpty(input.sites, which, input.threads, rows);
  return {};
}

bool findAllInMesh(const SearchInput& input, NeighborRows& rows) {
  std::vector<std::uint32_t> all(input.sites.size());
  std::iota(all.begin(), all.end(), 0u);
  auto found = input.judge.findInMesh(all, input.threads);
  if (!found) return false;
  rows.add(all, std::move(*found));
  proveEmpty(input.sites, all, input.threads, rows);
  return true;
}

namespace {

/// Asks the device, and keeps what it finds.
class DeviceSearch {
 public:
  DeviceSearch(const SearchInput& input, NeighborRows& rows) : input_(input), rows_(rows) {}

  Result<void> byGrid(const Tile& tile, std::span<const std::uint32_t> which, Effort effort,
                      std::span<CellStatus> status) {
    CellNeighbors found;
    auto asked = askCells(input_.backend, tile.sites.size(), which, effort, input_.threads, found);
    if (!asked) return asked;
    std::ranges::copy(found.status, status.begin());
    if (tile.whole.empty()) {
      rows_.add(which, std::move(found));
      return {};
    }
    std::vector<std::uint32_t> whole;
    for (const auto site : which) whole.push_back(tile.whole[site]);
    parallelFor(which.size(), grain, input_.threads, [&](std::size_t begin, std::size_t end) {
      for (auto e = begin; e < end; ++e) {
        renumber(found, e, [&](std::uint32_t site) { return tile.whole[site]; });
      }
    });
    rows_.add(whole, std::move(found));
    return {};
  }

  /// Clips with the most room whatever the effort, and turns places in lists into sites.
  Result<void> byLists(const Candidates& candidates, std::span<CellStatus> status) {
    const Stopwatch watch;
    packBatch(input_.sites, candidates, 0, candidates.site.size(), input_.threads, batch_);
    pack_seconds_ += watch.seconds();
    CellNeighbors found;
    if (auto asked = askCells(input_.backend, batch_, input_.threads, found); !asked) return asked;
    // There is no more room than that.
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

  const SearchInput& input_;
  NeighborRows& rows_;
  CellBatch<double> batch_;
  double pack_seconds_ = 0;
};

}  // namespace

Result<NeighborRows> findNeighbors(const SearchInput& input, Report& report) {
  NeighborRows rows(input.sites.size(), input.threads);
  Upload upload(input.backend, {});
  CellLadder ladder(input, upload, 0);
  DeviceSearch device(input, rows);
  auto judged = ladder.climb({[&](const Tile& tile, auto which, Effort effort, auto status) {
                                return device.byGrid(tile, which, effort, status);
                              },
                              [&](const Candidates& candidates, Effort, auto status) {
                                return device.byLists(candidates, status);
                              }});
  if (!judged) return tl::unexpected(judged.error());
  rows.add(judged->which, std::move(judged->found));
  ladder.describe(report);
  if (input.search.method == Search::grid) {
    report.time_ms.upload = 1e3 * upload.seconds();
  } else if (report.time_ms.search >= 0) {
    report.time_ms.search += 1e3 * device.packSeconds();
  }
  std::vector<std::uint32_t> all(input.sites.weight.size());
  std::iota(all.begin(), all.end(), 0u);
  proveEmpty(input.sites, all, input.threads, rows);
  return rows;
}

}  // namespace vorpipe::core
