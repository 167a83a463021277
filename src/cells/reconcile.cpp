#include "cells/reconcile.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/refusal.h"
#include "base/try.h"
#include "cells/hidden_cells.h"
#include "cells/tied_records.h"

namespace vorpipe::core {
namespace {

/// The precision with which each disputed cell was found last.
class Precisions {
 public:
  explicit Precisions(std::size_t cells) : cells_(cells) {}

  /// Returns the cells among `disputed` to find again, and how: in double if that is untried, else exactly.
  /// Both sides of a dispute are among them, so one of them has something left to try.
  std::pair<std::vector<std::uint32_t>, Precision> next(const std::vector<std::uint32_t>& disputed) {
    for (const auto precision : {Precision::in_double, Precision::exact}) {
      auto which = notYet(disputed, precision);
      if (!which.empty()) return {std::move(which), precision};
    }
    return {{}, Precision::exact};
  }

  /// Returns those of `cells` to be found exactly.
  std::vector<std::uint32_t> notExact(const std::vector<std::uint32_t>& cells) {
    return notYet(cells, Precision::exact);
  }

 private:
  enum class Last : std::uint8_t { by_device, in_double, exact };

  /// Returns the cells not yet found with this precision, and notes them as found with it.
  std::vector<std::uint32_t> notYet(const std::vector<std::uint32_t>& cells, Precision precision) {
    std::vector<std::uint32_t> which;
    if (cells.empty()) return which;
    if (last_.empty()) last_.assign(cells_, Last::by_device);
    const auto now = precision == Precision::exact ? Last::exact : Last::in_double;
    for (const auto cell : cells) {
      if (last_[cell] >= now) continue;
      which.push_back(cell);
      last_[cell] = now;
    }
    return which;
  }

  std::size_t cells_;
  std::vector<Last> last_;  ///< empty until something is in dispute
};

void addWithNeighbors(const NeighborRows& rows, const std::vector<std::uint32_t>& which,
                      std::vector<std::uint32_t>& cells) {
  const auto count = rows.size();
  for (const auto cell : which) {
    cells.push_back(cell);
    for (const auto neighbor : rows.edges(cell)) {
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

/// The disputed cells that are certified although their neighbors leave nothing of them.
std::vector<std::uint32_t> cellsWithoutArea(const SiteSet& sites, const NeighborRows& rows,
                                            const std::vector<std::uint32_t>& disputed) {
  std::vector<std::uint32_t> cells;
  if (sites.weight.empty()) return cells;
  std::copy_if(disputed.begin(), disputed.end(), std::back_inserter(cells), [&](std::uint32_t cell) {
    return rows.status(cell) == CellStatus::certified && leaveNothing(sites, cell, rows.edges(cell));
  });
  return cells;
}

/// Cells of sites with weights all of whose edges are ties: only exact arithmetic distinguishes them from
/// cells of hidden sites.
std::vector<std::uint32_t> cellsOfTies(const ProposedCells& proposed, const TiedCells& tied) {
  std::vector<std::uint32_t> cells;
  if (proposed.sites.weight.empty()) return cells;
  for (std::size_t k = 0; k < tied.cell.size(); ++k) {
    const auto begin = tied.tie.begin() + static_cast<std::ptrdiff_t>(tied.offsets[k]);
    const auto end = tied.tie.begin() + static_cast<std::ptrdiff_t>(tied.offsets[k + 1]);
    const bool has_cell = proposed.cells.status(tied.cell[k]) == CellStatus::certified;
    if (has_cell && std::find(begin, end, 0) == end) cells.push_back(tied.cell[k]);
  }
  return cells;
}

/// The next cells to find again, and how. If all disputed cells are exact already, a cell beside them that
/// agrees with both sides must be wrong. Then tries the rings of cells around them, one after the other.
std::pair<std::vector<std::uint32_t>, Precision> nextAround(const NeighborRows& rows,
                                                            std::vector<std::uint32_t> disputed,
                                                            Precisions& precisions) {
  constexpr int rings = 3;
  auto next = precisions.next(disputed);
  for (int ring = 0; next.first.empty() && ring < rings; ++ring) {
    std::vector<std::uint32_t> wider;
    addWithNeighbors(rows, disputed, wider);
    sortUnique(wider);
    disputed = std::move(wider);
    next = precisions.next(disputed);
  }
  return next;
}

/// Checks cells and finds disputed ones again, until there are none.
class Reconciliation {
 public:
  Reconciliation(const SearchInput& input, NeighborRows& rows, const Records& records, Report& report)
      : input_(input),
        sites_(input.sites),
        rows_(rows),
        records_(records),
        report_(report),
        precisions_(input.sites.size()),
        suspect_(input.sites.size()) {}

  Result<TiedCells> run() {
    for (;;) {
      const EdgeIndex index(rows_, input_.threads);
      const ProposedCells proposed{sites_, rows_, index, input_.threads};
      if (all_changed_) {
        checkCells(proposed, records_, suspect_);
      } else {
        checkCells(proposed, changed_, records_, suspect_);
      }
      all_changed_ = false;
      changed_.clear();
      const auto disputes = resort_ == Resort::ties ? Disputes::are_ties : Disputes::are_listed;
      auto tied = resolveTies(proposed, suspect_, fineness_, disputes, records_);
      if (!tied) return tied;
      const auto done = mend(proposed, *tied);
      if (!done) return tl::unexpected(done.error());
      if (*done) {
        recordTiedCells(proposed, *tied, records_);
        return tied;
      }
    }
  }

 private:
  /// Fallbacks if the judge has nothing left to try. mesh: all cells come from the triangulation, and so
  /// agree. ties: edges still in dispute become ties; correct cells may disagree where ties join more than
  /// they should.
  enum class Resort : std::uint8_t { judge, mesh, ties };

  /// Break-even between exact cells, which take up to a second each where many bisectors nearly meet in a
  /// point, and the mesh of all sites.
  static constexpr std::size_t most_exact = 64;

  /// Changes cells that are disputed or not sure enough. Returns true if there are none.
  Result<bool> mend(const ProposedCells& proposed, const TiedCells& tied) {
    for (const auto cell : tied.enclosed) suspect_[cell] = 1;
    if (!tied.enclosed.empty()) return false;
    const bool agreed = tied.disputed.empty();
    const auto doubtful = agreed ? cellsOfTies(proposed, tied) : tied.disputed;
    if (resort_ != Resort::ties && dropVanished(doubtful)) return false;
    if (resort_ == Resort::judge) {
      const auto [which, precision] =
          agreed ? precisions_.next(doubtful) : nextAround(rows_, doubtful, precisions_);
      const bool many = precision == Precision::exact && which.size() > most_exact && input_.judge.hasMesh();
      if (!which.empty() && !many) return find(which, precision);
      if (many) return takeResort(doubtful);
    }
    if (agreed) return narrow(tied);
    return takeResort(doubtful);
  }

  /// Makes ties finer where they make vertices wide. Returns true if no vertex is wide. Decides this, and
  /// which edges at walls count, on exact cells: then results do not depend on the backend.
  Result<bool> narrow(const TiedCells& tied) {
    if (resort_ == Resort::judge) {
      const auto which = precisions_.notExact(tied.unsure);
      if (which.size() > most_exact && input_.judge.hasMesh()) return takeResort(which);
      if (!which.empty()) return find(which, Precision::exact);
    }
    fineness_.increase(tied.wide, sites_.size());
    return tied.wide.empty();
  }

  /// Drops cells that have no area after all. Returns whether there were any.
  bool dropVanished(const std::vector<std::uint32_t>& doubtful) {
    const auto vanished = cellsWithoutArea(sites_, rows_, doubtful);
    addWithNeighbors(rows_, vanished, changed_);
    sortUnique(changed_);
    for (const auto cell : vanished) rows_.drop(cell, CellStatus::empty);
    return !vanished.empty();
  }

  /// Finds the cells `which` again. Their neighbors, old and new, are checked again too: an edge is right
  /// only if both of its cells have it.
  Result<bool> find(const std::vector<std::uint32_t>& which, Precision precision) {
    addWithNeighbors(rows_, which, changed_);
    VORPIPE_TRY(findAgain(input_, which, precision, rows_));
    (precision == Precision::exact ? report_.exact : report_.in_double) += which.size();
    addWithNeighbors(rows_, which, changed_);
    sortUnique(changed_);
    return false;
  }

  Result<bool> takeResort(const std::vector<std::uint32_t>& doubtful) {
    if (resort_ == Resort::ties) {
      return tl::unexpected(refusal(
          Subject::sites, fmt::format("the cells of {} sites around site {} disagree beyond exact arithmetic",
                                      doubtful.size(), sites_.id[doubtful[0]])));
    }
    if (resort_ == Resort::judge && findAllInMesh(input_, rows_)) {
      report_.exact += sites_.size();
      resort_ = Resort::mesh;
      suspect_.assign(suspect_.size(), 0);
      all_changed_ = true;
    } else {
      resort_ = Resort::ties;
    }
    return false;
  }

  const SearchInput& input_;
  const SiteSet& sites_;
  NeighborRows& rows_;
  const Records& records_;
  Report& report_;
  Precisions precisions_;
  Fineness fineness_;
  std::vector<std::uint8_t> suspect_;
  std::vector<std::uint32_t> changed_;
  bool all_changed_ = true;
  Resort resort_ = Resort::judge;
};

}  // namespace

Result<TiedCells> reconcileCells(const SearchInput& input, NeighborRows& rows, const Records& records,
                                 Report& report) {
  return Reconciliation(input, rows, records, report).run();
}

}  // namespace vorpipe::core
