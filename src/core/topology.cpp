#include "core/topology.h"

#include <algorithm>
#include <numeric>

#include "core/host_search.h"
#include "core/pack.h"

namespace vorpipe {
namespace {

constexpr std::size_t lines_per_batch = std::size_t{1} << 20;
constexpr std::size_t host_cells_at_once = std::size_t{1} << 15;

Result<void> report(const Progress& progress, const char* stage, std::size_t done, std::size_t of) {
  if (!progress || progress(stage, static_cast<double>(done) / static_cast<double>(of))) return {};
  return tl::unexpected(Error{ErrorCode::cancelled, "interrupted"});
}

/// Appends entry e of clipped cells; one that is neither certified nor empty comes out without edges.
void appendCell(const Candidates& candidates, const CellPolygons& polygons, std::size_t e,
                Topology& topology) {
  const auto status = polygons.status[e];
  topology.status.push_back(status);
  if (status == CellStatus::certified) {
    for (auto v = polygons.first[e]; v < polygons.first[e + 1]; ++v) {
      const auto line = polygons.line[v];
      topology.neighbor.push_back(
          line < 0 ? std::int64_t{line}
                   : std::int64_t{candidates.index[candidates.first[e] + static_cast<std::uint32_t>(line)]});
    }
  }
  topology.first.push_back(topology.neighbor.size());
}

Result<Topology> clipAll(const TopologyInput& input) {
  const auto& info = input.backend.info();
  const auto lines = std::min<std::uint64_t>(info.max_lines, lines_per_batch);
  const auto at_once = std::clamp<std::size_t>(lines / input.neighbors, 1, info.max_entries);
  std::vector<std::uint32_t> which(input.sites.size());
  std::iota(which.begin(), which.end(), 0u);
  Topology topology;
  CellBatch<double> batch;
  CellPolygons polygons;
  for (std::size_t begin = 0; begin < which.size(); begin += at_once) {
    if (auto go_on = report(input.progress, "cells", begin, which.size()); !go_on) {
      return tl::unexpected(go_on.error());
    }
    const auto count = std::min(at_once, which.size() - begin);
    const auto candidates = input.search.neighbors(std::span(which).subspan(begin, count), input.neighbors);
    packBatch(input.sites, candidates, 0, count, input.threads, batch);
    if (auto clipped = input.backend.cells(batch, polygons); !clipped) return tl::unexpected(clipped.error());
    for (std::size_t e = 0; e < count; ++e) appendCell(candidates, polygons, e, topology);
  }
  return topology;
}

/// Replaces the cells of `which`, in ascending order, by those of `found`.
void replaceCells(const std::vector<std::uint32_t>& which, const Topology& found, Topology& topology) {
  Topology merged;
  merged.status = std::move(topology.status);
  merged.neighbor.reserve(topology.neighbor.size() + found.neighbor.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < merged.status.size(); ++i) {
    const bool replaced = next < which.size() && which[next] == i;
    const auto& from = replaced ? found : topology;
    const auto place = replaced ? next : i;
    if (replaced) merged.status[i] = found.status[next++];
    merged.neighbor.insert(merged.neighbor.end(),
                           from.neighbor.begin() + static_cast<std::ptrdiff_t>(from.first[place]),
                           from.neighbor.begin() + static_cast<std::ptrdiff_t>(from.first[place + 1]));
    merged.first.push_back(merged.neighbor.size());
  }
  topology = std::move(merged);
}

}  // namespace

Result<void> findAgain(const TopologyInput& input, const std::vector<std::uint32_t>& which,
                       Topology& topology) {
  Topology found;
  for (std::size_t begin = 0; begin < which.size(); begin += host_cells_at_once) {
    if (auto go_on = report(input.progress, "cells in double", begin, which.size()); !go_on) return go_on;
    const auto count = std::min(host_cells_at_once, which.size() - begin);
    const auto cells = findCells(input.sites, input.search, input.judge,
                                 std::span(which).subspan(begin, count), input.threads);
    if (!cells) return tl::unexpected(cells.error());
    for (std::size_t e = 0; e < count; ++e) appendCell(cells->candidates, cells->polygons, e, found);
  }
  replaceCells(which, found, topology);
  return {};
}

Result<Topology> findTopology(const TopologyInput& input, std::uint64_t& in_double) {
  auto topology = clipAll(input);
  if (!topology) return topology;
  std::vector<std::uint32_t> failed;
  for (std::uint32_t i = 0; i < topology->status.size(); ++i) {
    const auto status = topology->status[i];
    if (status != CellStatus::certified && status != CellStatus::empty) failed.push_back(i);
  }
  in_double += failed.size();
  if (auto found = findAgain(input, failed, *topology); !found) return tl::unexpected(found.error());
  return topology;
}

}  // namespace vorpipe
