#include "core/corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/hidden.h"

namespace vorpipe {
namespace {

/// The last effort that a disputed cell was found with.
class Efforts {
 public:
  explicit Efforts(std::size_t cells) : cells_(cells) {}

  /// The cells among `disputed` to find again, and how: in double where that has not been tried yet, else
  /// exactly. Both sides of a dispute are among them, so that one of them has something left to try.
  std::pair<std::vector<std::uint32_t>, Effort> next(const std::vector<std::uint32_t>& disputed) {
    if (disputed.empty()) return {{}, Effort::exact};
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
  const auto count = topology.size();
  for (const auto cell : which) {
    cells.push_back(cell);
    for (const auto neighbor : topology.edges(cell)) {
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
    return topology.status(cell) == CellStatus::certified && leaveNothing(sites, cell, topology.edges(cell));
  });
  return cells;
}

/// Cells of sites with weights all of whose edges are ties: it takes exact numbers to tell them from hidden
/// ones.
std::vector<std::uint32_t> cellsOfTies(const ProposedCells& proposed, const TiedCells& tied) {
  std::vector<std::uint32_t> cells;
  if (proposed.sites.weight.empty()) return cells;
  for (std::size_t k = 0; k < tied.cell.size(); ++k) {
    const auto begin = tied.tie.begin() + static_cast<std::ptrdiff_t>(tied.first[k]);
    const auto end = tied.tie.begin() + static_cast<std::ptrdiff_t>(tied.first[k + 1]);
    const bool has_cell = proposed.cells.status(tied.cell[k]) == CellStatus::certified;
    if (has_cell && std::find(begin, end, 0) == end) cells.push_back(tied.cell[k]);
  }
  return cells;
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

}  // namespace

Result<TiedCells> agreeOnCells(const TopologyInput& input, Topology& topology, const Records& records,
                               Report& report) {
  std::vector<std::uint8_t> rough(input.sites.size());
  Efforts efforts(input.sites.size());
  std::vector<std::uint32_t> changed;
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
    const bool agreed = tied->disputed.empty();
    const auto doubtful = agreed ? cellsOfTies(proposed, *tied) : std::move(tied->disputed);
    const auto vanished = cellsWithoutArea(input.sites, topology, doubtful);
    if (!vanished.empty()) {
      changed.clear();
      addWithNeighbors(topology, vanished, changed);
      sortUnique(changed);
      for (const auto cell : vanished) topology.drop(cell, CellStatus::empty);
      continue;
    }
    const auto [which, effort] = agreed ? efforts.next(doubtful) : nextAround(topology, doubtful, efforts);
    if (agreed && which.empty()) {
      recordTiedCells(proposed, *tied, records);
      return tied;
    }
    if (which.empty()) {
      return tl::unexpected(
          Error{ErrorCode::input,
                fmt::format("the cells of {} sites around site {} disagree beyond exact arithmetic",
                            doubtful.size(), input.sites.id[doubtful[0]])});
    }
    // Whoever is or was a neighbor of a changed cell may have to be judged anew.
    changed.clear();
    addWithNeighbors(topology, which, changed);
    if (auto found = findAgain(input, which, effort, topology); !found) return tl::unexpected(found.error());
    (effort == Effort::exact ? report.exact : report.in_double) += which.size();
    addWithNeighbors(topology, which, changed);
    sortUnique(changed);
  }
}

}  // namespace vorpipe
