#include "cells/agreed_cells.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/stopwatch.h"
#include "base/try.h"
#include "cells/diagram_writer.h"
#include "cells/dual_triangles.h"
#include "cells/hidden_cells.h"
#include "cells/ties.h"

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

 private:
  enum class Last : std::uint8_t { by_device, in_double, exact };

  std::size_t cells_;
  std::vector<Last> last_;  ///< empty until something is in dispute
};

void addWithNeighbors(const NeighborRows& rows, const std::vector<std::uint32_t>& which,
                      std::vector<std::uint32_t>& cells) {
  for (const auto cell : which) {
    cells.push_back(cell);
    for (const auto neighbor : rows.edges(cell)) {
      const auto other = static_cast<std::uint32_t>(neighbor);
      if (neighbor >= 0 && other < rows.size()) cells.push_back(other);
    }
  }
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
    const bool has_cell = proposed.cells.status(tied.cell[k]) == CellStatus::certified;
    const auto ties = tied.ties(k);
    if (has_cell && std::ranges::find(ties, 0) == ties.end()) cells.push_back(tied.cell[k]);
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
    sortWithoutRepeats(wider);
    disputed = std::move(wider);
    next = precisions.next(disputed);
  }
  return next;
}

/// Checks all cells and writes their records. Disputed cells are found again, in double and then exactly,
/// until no dispute is left. Updates `rows`; `report` counts what was found again. Returns the cells at ties,
/// which differ from their rows. Errors: those of the exact search; exact cells still differ about an edge.
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
      const auto disputes = source_ == Source::ties ? Disputes::are_ties : Disputes::are_listed;
      auto tied = resolveTies(proposed, suspect_, fineness_, disputes, records_);
      if (!tied) return tied;
      VORPIPE_LET(done, repair(proposed, *tied));
      if (done) {
        recordTiedCells(proposed, *tied, records_);
        return tied;
      }
    }
  }

 private:
  /// Fallbacks if the exact search has nothing left to try. mesh: all cells come from the triangulation, and
  /// so agree. ties: edges still in dispute become ties; correct cells may disagree where ties join more than
  /// they should.
  enum class Source : std::uint8_t { search, mesh, ties };

  /// Break-even between exact cells, which take up to a second each where many bisectors nearly meet in a
  /// point, and the mesh of all sites.
  static constexpr std::size_t most_exact = 64;

  /// Changes cells that are disputed or not sure enough. Returns true if there are none.
  Result<bool> repair(const ProposedCells& proposed, const TiedCells& tied) {
    for (const auto cell : tied.enclosed) suspect_[cell] = 1;
    if (!tied.enclosed.empty()) return false;
    const bool agreed = tied.disputed.empty();
    const auto doubtful = agreed ? cellsOfTies(proposed, tied) : tied.disputed;
    if (source_ != Source::ties && dropVanished(doubtful)) return false;
    if (source_ == Source::search) {
      const auto [which, precision] =
          agreed ? precisions_.next(doubtful) : nextAround(rows_, doubtful, precisions_);
      const bool many =
          precision == Precision::exact && which.size() > most_exact && input_.exact_search.hasMesh();
      if (!which.empty() && !many) return find(which, precision);
      if (many) return fallBack(doubtful);
    }
    if (agreed) return narrow(tied);
    return fallBack(doubtful);
  }

  /// Makes ties finer where they make vertices wide. Returns true if no vertex is wide. Decides this, and
  /// which edges at walls count, on exact cells: then results do not depend on the backend.
  Result<bool> narrow(const TiedCells& tied) {
    if (source_ == Source::search) {
      const auto which = precisions_.notYet(tied.unsure, Precision::exact);
      if (which.size() > most_exact && input_.exact_search.hasMesh()) return fallBack(which);
      if (!which.empty()) return find(which, Precision::exact);
    }
    fineness_.increase(tied.wide, sites_.size());
    return tied.wide.empty();
  }

  /// Drops cells that have no area after all. Returns whether there were any.
  bool dropVanished(const std::vector<std::uint32_t>& doubtful) {
    const auto vanished = cellsWithoutArea(sites_, rows_, doubtful);
    addWithNeighbors(rows_, vanished, changed_);
    sortWithoutRepeats(changed_);
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
    sortWithoutRepeats(changed_);
    return false;
  }

  Result<bool> fallBack(const std::vector<std::uint32_t>& doubtful) {
    if (source_ == Source::ties) {
      return tl::unexpected(refusal(
          Subject::sites, fmt::format("the cells of {} sites around site {} disagree beyond exact arithmetic",
                                      doubtful.size(), sites_.id[doubtful[0]])));
    }
    if (source_ == Source::search && findAllInMesh(input_, rows_)) {
      report_.exact += sites_.size();
      source_ = Source::mesh;
      suspect_.assign(suspect_.size(), 0);
      all_changed_ = true;
    } else {
      source_ = Source::ties;
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
  Source source_ = Source::search;
};

/// Makes cells agree such that their areas add up to the domain's. If the sum is off although neighbors agree
/// everywhere, the diagram overlaps itself. Then no single cell is known to be wrong, so all are found again.
Result<TiedCells> reconcile(const SearchInput& input, NeighborRows& rows, const Records& records,
                            const Box& domain, Report& report) {
  auto tied = Reconciliation(input, rows, records, report).run();
  if (!tied || std::abs(areaGap(records.by_input, domain, input.threads)) <= area_rounding) return tied;
  const auto all = allOf(input.sites);
  VORPIPE_TRY(findAgain(input, all, Precision::in_double, rows));
  report.in_double += all.size();
  tied = Reconciliation(input, rows, records, report).run();
  if (!tied) return tied;
  const double gap = areaGap(records.by_input, domain, input.threads);
  if (std::abs(gap) <= area_wrong) return tied;
  return tl::unexpected(refusal(
      Subject::sites,
      fmt::format("the areas of all cells add up to {} of the domain's, beyond what rounding explains",
                  1 + gap)));
}

/// The centroid of a site without a cell is the caller's site, to the last bit: scaled ones may be rounded.
void keepSitesWithoutCells(const Sites& sites, int threads, Diagram& diagram) {
  constexpr std::size_t grain = 1 << 14;
  parallelEach(sites.size(), grain, threads, [&](std::size_t i) {
    if (diagram.status[i] == Status::empty) diagram.centroid[i] = {sites.x[i], sites.y[i]};
  });
}

}  // namespace

Result<std::optional<AgreedCells>> agreeOnCells(const Machine& machine, SiteRun& run, const Sites& sites,
                                                const CellsOptions& options, AtEmpty at_empty,
                                                std::span<double> spread, Report& report) {
  const SiteSet& set = run.prepared.set;
  // A duplicate has no cell.
  if (at_empty == AtEmpty::end && set.size() < sites.size()) return std::nullopt;
  const SearchInput input{machine.backend, run.exact_search, set,
                          options.search,  machine.threads,  options.progress};
  VORPIPE_VAR(rows, findNeighbors(input, at_empty, report));
  if (!rows) return std::nullopt;
  AgreedCells agreed{std::move(*rows), makeRecords(run.prepared, sites), {}};
  const Records records{set, Unscale(run.prepared.exponent), agreed.records, spread};
  VORPIPE_VAR(tied, reconcile(input, agreed.rows, records, options.domain, report));
  agreed.tied = std::move(tied);
  return std::optional(std::move(agreed));
}

Result<Diagram> boxDiagramOn(const Machine& machine, SiteRun& run, const Sites& sites,
                             const CellsOptions& options) {
  Diagram diagram;
  auto& times = diagram.report.time_ms;
  const Stopwatch watch;
  const int threads = machine.threads;
  const SiteSet& set = run.prepared.set;
  VORPIPE_VAR(found, agreeOnCells(machine, run, sites, options, AtEmpty::ignore, {}, diagram.report));
  AgreedCells& agreed = *found;
  // Only triangles need the cells at each vertex.
  if (options.detail != Detail::everything) {
    std::vector<std::uint32_t>().swap(agreed.tied.around);
    std::vector<std::uint32_t>().swap(agreed.tied.around_offsets);
  }
  takeRecords(agreed.records, options.detail, threads, diagram);
  BigVector<CellRecord>().swap(agreed.records);  // assigning an empty one would keep the memory
  if (diagram.report.empty > 0) keepSitesWithoutCells(sites, threads, diagram);
  if (!set.weight.empty()) diagram.report.hidden = diagram.report.empty;
  {
    const EdgeIndex index(agreed.rows, threads);
    const ProposedCells cells{set, agreed.rows, index, threads};
    writeEdges(cells, agreed.tied, options.detail, Unscale(run.prepared.exponent), diagram);
    if (options.detail == Detail::everything) diagram.triangles = dualTriangles(cells, agreed.tied, run.mesh);
  }
  run.cells = std::move(agreed.rows);
  diagram.owner = std::move(run.prepared.owner);
  times.cells = 1e3 * watch.seconds() - std::max(times.upload, 0.0) - std::max(times.search, 0.0);
  nameDevice(machine.backend, diagram.report);
  return diagram;
}

}  // namespace vorpipe::core
