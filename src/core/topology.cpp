#include "core/topology.h"

#include <numeric>

#include "core/distinct.h"
#include "core/gather.h"
#include "core/grid_topology.h"
#include "core/hidden.h"
#include "core/list_topology.h"
#include "core/row_start.h"
#include "core/triage.h"

namespace vorpipe {

void replaceCells(std::span<const std::uint32_t> which, Neighborhoods found, int threads,
                  Topology& topology) {
  std::vector<std::uint32_t> all(topology.status.size());
  std::iota(all.begin(), all.end(), 0u);
  Gathering gathering(all.size(), threads);
  gathering.add(all, std::move(topology));
  gathering.add(which, std::move(found));
  topology = gathering.finish();
}

Result<void> findAgain(const TopologyInput& input, const std::vector<std::uint32_t>& which, Effort effort,
                       Topology& topology) {
  std::uint64_t exact = 0;
  auto found = input.judge.find(which, effort, input.threads, input.progress, exact);
  if (!found) return tl::unexpected(found.error());
  proveEmpty(input.sites, which, input.threads, *found);
  for (std::size_t e = 0; e < which.size(); ++e) beginAtFirst(input.sites, edgesOf(*found, e));
  replaceCells(which, std::move(*found), input.threads, topology);
  return {};
}

Result<Topology> findTopology(const TopologyInput& input, Report& report) {
  const bool by_grid = input.search.method == Search::grid;
  const auto triage = sortOut(input.sites, input.threads);
  Gathering gathering(input.sites.size(), input.threads);
  auto left = by_grid ? findByGrid(input, triage.inside, gathering, report)
                      : findByLists(input, triage.inside, gathering, report);
  if (!left) return tl::unexpected(left.error());
  left->insert(left->end(), triage.outside.begin(), triage.outside.end());
  sortDistinct(*left, static_cast<std::uint32_t>(input.sites.size()));
  report.in_double += left->size();
  auto found = input.judge.find(*left, Effort::in_double, input.threads, input.progress, report.exact);
  if (!found) return tl::unexpected(found.error());
  gathering.add(*left, std::move(*found));
  auto topology = gathering.finishFromFirst(input.sites);
  std::vector<std::uint32_t> all(input.sites.weight.size());
  std::iota(all.begin(), all.end(), 0u);
  proveEmpty(input.sites, all, input.threads, topology);
  return topology;
}

}  // namespace vorpipe
