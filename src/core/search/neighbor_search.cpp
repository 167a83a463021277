#include "core/search/neighbor_search.h"

#include <numeric>
#include <utility>

#include "base/distinct.h"
#include "core/judge/hidden_cells.h"
#include "core/search/device_eligible.h"
#include "core/search/grid_search.h"
#include "core/search/list_search.h"

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

Result<NeighborRows> findNeighbors(const SearchInput& input, Report& report) {
  const bool by_grid = input.search.method == Search::grid;
  const auto triage = sortOut(input.sites, input.threads);
  NeighborRows rows(input.sites.size(), input.threads);
  auto left = by_grid ? findByGrid(input, triage.inside, rows, report)
                      : findByLists(input, triage.inside, rows, report);
  if (!left) return tl::unexpected(left.error());
  left->insert(left->end(), triage.outside.begin(), triage.outside.end());
  sortDistinct(*left, static_cast<std::uint32_t>(input.sites.size()));
  report.in_double += left->size();
  auto found = input.judge.find(*left, Precision::in_double, input.threads, input.progress, report.exact);
  if (!found) return tl::unexpected(found.error());
  rows.add(*left, std::move(*found));
  std::vector<std::uint32_t> all(input.sites.weight.size());
  std::iota(all.begin(), all.end(), 0u);
  proveEmpty(input.sites, all, input.threads, rows);
  return rows;
}

}  // namespace vorpipe::core
