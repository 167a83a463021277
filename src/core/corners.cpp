#include "core/corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/hidden.h"
#include "core/row_start.h"
#include "parallel.h"

namespace vorpipe {
namespace {

constexpr std::size_t grain = 4096;

/// The last effort that a disputed cell was found with.
class Efforts {
 public:
  explicit Efforts(std::size_t cells) : cells_(cells) {}

  /// The cells among `disputed` to find again, and how: in double where that has not been tried yet, else
  /// exactly. Both sides of a dispute are among them, so that one of them has something left to try.
  std::pair<std::vector<std::uint32_t>, Effort> next(const std::vector<std::uint32_t>& disputed) {
    if (last_.empty()) last_.assign(cells_, Effort::fast);
    for (const auto effort : {Effort::in_double, Effort::exact}) {
      std::vector<std::uint32_t> which;
      for (const auto cell : disputed) {
        if (last_[cell] >= effort) continue;
        which.push_back(cell);
        last_[cell] = effort;
      }
      if (!which.empty()) return {std::move(which), effort};
    }
    return {{}, Effort::exact};
  }

 private:
  std::size_t cells_;
  std::vector<Effort> last_;  ///< empty until something is in dispute
};

void addWithNeighbors(const Topology& topology, const std::vector<std::uint32_t>& which,
                      std::vector<std::uint32_t>& cells) {
  const auto count = topology.status.size();
  for (const auto cell : which) {
    cells.push_back(cell);
    for (const auto neighbor : edgesOf(topology, cell)) {
      if (neighbor >= 0 && static_cast<std::size_t>(neighbor) < count) {
        cells.push_back(static_cast<std::uint32_t>(neighbor));
      }
    }
  }
}

void sortUnique(std::vector<std::uint32_t>& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

/// Those of the disputed cells that are certified, although their neighbors leave nothing of them.
std::vector<std::uint32_t> cellsWithoutArea(const SiteSet& sites, const Topology& topology,
                                            const std::vector<std::uint32_t>& disputed) {
  std::vector<std::uint32_t> cells;
  if (sites.weight.empty()) return cells;
  std::copy_if(disputed.begin(), disputed.end(), std::back_inserter(cells), [&](std::uint32_t cell) {
    return topology.status[cell] == CellStatus::certified &&
           leaveNothing(sites, cell, edgesOf(topology, cell));
  });
  return cells;
}

Neighborhoods emptyCells(std::size_t count) {
  return {std::vector(count, CellStatus::empty), std::vector<std::uint64_t>(count + 1), {}};
}

/// What to try for cells in dispute. Where they cannot be blamed, since all of them are exact, a cell beside
/// them must be wrong that agrees with both sides: the rings of cells around them, one after the other.
std::pair<std::vector<std::uint32_t>, Effort> nextAround(const Topology& topology,
                                                         std::vector<std::uint32_t> disputed,
                                                         Efforts& efforts) {
  constexpr int rings = 3;
  auto next = efforts.next(disputed);
  for (int ring = 0; next.first.empty() && ring < rings; ++ring) {
    std::vector<std::uint32_t> wider;
    addWithNeighbors(topology, disputed, wider);
    sortUnique(wider);
    disputed = std::move(wider);
    next = efforts.next(disputed);
  }
  return next;
}

std::span<std::int32_t> rowOf(Topology& topology, std::size_t cell) {
  return std::span(topology.neighbor)
      .subspan(topology.first[cell], topology.first[cell + 1] - topology.first[cell]);
}

}  // namespace

Result<TiedCells> agreeOnCells(const TopologyInput& input, Topology& topology, const Records& records,
                               Report& report) {
  std::vector<std::uint8_t> rough(input.sites.size());
  Efforts efforts(input.sites.size());
  std::vector<std::uint32_t> changed;
  parallelFor(input.sites.size(), grain, input.threads, [&](std::size_t begin, std::size_t end) {
    for (auto cell = begin; cell < end; ++cell) beginAtFirst(input.sites, rowOf(topology, cell));
  });
  for (bool all = true;; all = false) {
    const EdgeIndex index(topology, input.threads);
    const ProposedCells proposed{input.sites, topology, index, input.threads};
    if (all) {
      checkCells(proposed, records, rough);
    } else {
      checkCells(proposed, changed, records, rough);
    }
    auto tied = untieCells(proposed, rough);
    if (!tied) return tied;
    if (tied->disputed.empty()) {
      recordTiedCells(proposed, *tied, records);
      return tied;
    }
    const auto vanished = cellsWithoutArea(input.sites, topology, tied->disputed);
    if (!vanished.empty()) {
      changed.clear();
      addWithNeighbors(topology, vanished, changed);
      sortUnique(changed);
      replaceCells(vanished, emptyCells(vanished.size()), input.threads, topology);
      continue;
    }
    const auto [which, effort] = nextAround(topology, tied->disputed, efforts);
    if (which.empty()) {
      return tl::unexpected(
          Error{ErrorCode::input,
                fmt::format("the cells of {} sites around site {} disagree beyond exact arithmetic",
                            tied->disputed.size(), input.sites.id[tied->disputed[0]])});
    }
    // Whoever is or was a neighbor of a changed cell may have to be judged anew.
    changed.clear();
    addWithNeighbors(topology, which, changed);
    if (auto found = findAgain(input, which, effort, topology); !found) return tl::unexpected(found.error());
    for (const auto cell : which) beginAtFirst(input.sites, rowOf(topology, cell));
    (effort == Effort::exact ? report.exact : report.in_double) += which.size();
    addWithNeighbors(topology, which, changed);
    sortUnique(changed);
  }
}

}  // namespace vorpipe
