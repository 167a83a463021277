#include "cells/agreed_cells.h"

#include <fmt/core.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "base/refusal.h"
#include "base/try.h"
#include "cells/diagram_writer.h"
#include "cells/neighbor_search.h"
#include "cells/reconcile.h"

namespace vorpipe::core {
namespace {

/// Makes cells agree such that their areas add up to the domain's. If the sum is off although neighbors agree
/// everywhere, the diagram overlaps itself. Then no single cell is known to be wrong, so all are found again.
Result<TiedCells> reconcile(const SearchInput& input, NeighborRows& rows, const Records& records,
                            const Box& domain, Report& report) {
  auto tied = reconcileCells(input, rows, records, report);
  if (!tied || std::abs(areaGap(records.by_input, domain, input.threads)) <= area_rounding) return tied;
  std::vector<std::uint32_t> all(input.sites.size());
  std::iota(all.begin(), all.end(), 0u);
  VORPIPE_TRY(findAgain(input, all, Precision::in_double, rows));
  report.in_double += all.size();
  tied = reconcileCells(input, rows, records, report);
  if (!tied) return tied;
  const double gap = areaGap(records.by_input, domain, input.threads);
  if (std::abs(gap) <= area_wrong) return tied;
  return tl::unexpected(refusal(
      Subject::sites,
      fmt::format("the areas of all cells add up to {} of the domain's, beyond what rounding explains",
                  1 + gap)));
}

SearchInput inputOf(const Machine& machine, SiteRun& run, const CellsOptions& options) {
  return {machine.backend, run.judge, run.prepared.set, options.search, machine.threads, options.progress};
}

/// Makes cells with these neighbors agree.
Result<AgreedCells> agree(const SearchInput& input, NeighborRows rows, const SiteRun& run, const Sites& sites,
                          const Box& domain, std::span<double> spread, Report& report) {
  AgreedCells agreed{std::move(rows), makeRecords(run.prepared, sites), {}};
  const Records records{run.prepared.set, Unscale(run.prepared.exponent), agreed.records, spread};
  auto tied = reconcile(input, agreed.rows, records, domain, report);
  if (!tied) return tl::unexpected(tied.error());
  agreed.tied = std::move(*tied);
  return agreed;
}

}  // namespace

Result<AgreedCells> agreeOnCells(const Machine& machine, SiteRun& run, const Sites& sites,
                                 const CellsOptions& options, std::span<double> spread, Report& report) {
  const SearchInput input = inputOf(machine, run, options);
  auto rows = findNeighbors(input, report);
  if (!rows) return tl::unexpected(rows.error());
  return agree(input, std::move(*rows), run, sites, options.domain, spread, report);
}

Result<std::optional<AgreedCells>> agreeUnlessEmpty(const Machine& machine, SiteRun& run, const Sites& sites,
                                                    const CellsOptions& options, std::span<double> spread,
                                                    Report& report) {
  if (run.prepared.set.size() < sites.size()) return std::nullopt;  // A duplicate has no cell.
  const SearchInput input = inputOf(machine, run, options);
  auto rows = findNeighborsUnlessEmpty(input, report);
  if (!rows) return tl::unexpected(rows.error());
  if (!*rows) return std::nullopt;
  auto agreed = agree(input, std::move(**rows), run, sites, options.domain, spread, report);
  if (!agreed) return tl::unexpected(agreed.error());
  return std::optional(std::move(*agreed));
}

}  // namespace vorpipe::core
