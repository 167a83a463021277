#include <fmt/core.h>

#include <utility>

#include "base/disjoint_sets.h"
#include "base/try.h"
#include "cells/edge_twins.h"

namespace vorpipe {

using namespace core;

namespace {

Result<void> checkArrays(const Diagram& diagram) {
  if (diagram.vertices.size() == diagram.neighbors.size()) return {};
  return tl::unexpected(
      Error{ErrorCode::input,
            fmt::format("the diagram has {} neighbors and {} vertices: topology takes Detail::polygons",
                        diagram.neighbors.size(), diagram.vertices.size())});
}

/// Merges vertices of a periodic domain that are copies of each other: the ends of each edge in its two
/// cells.
void joinCopies(const Diagram& diagram, const std::vector<std::uint32_t>& twins, Topology& topology) {
  auto& vertex_of = topology.vertex_of;
  DisjointSets copies(topology.vertices.size());
  for (const Cell cell : diagram) {
    for (auto entry = cell.begin(); entry < cell.end(); ++entry) {
      const std::uint32_t twin = twins[entry];
      if (twin == no_twin) continue;
      const Cell other = diagram.cell(static_cast<std::size_t>(diagram.neighbors[entry]));
      copies.join(vertex_of[entry], vertex_of[nextEntry(diagram, other, twin)]);
    }
  }
  // The root is the first of the copies, so it gets its new number before the others need it.
  std::vector<std::uint32_t> renumbered(topology.vertices.size());
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < renumbered.size(); ++v) {
    const std::uint32_t root = copies.root(v);
    if (root == v) topology.vertices[count] = topology.vertices[v];
    renumbered[v] = root == v ? count++ : renumbered[root];
  }
  topology.vertices.resize(count);
  for (auto& vertex : vertex_of) vertex = renumbered[vertex];
}

/// On entry, `edge_of` holds the twin of each entry; replaces it by the entry's edge.
void numberEdges(const Diagram& diagram, Topology& topology) {
  auto& edge_of = topology.edge_of;
  std::size_t count = 0;
  for (std::size_t entry = 0; entry < edge_of.size(); ++entry) count += edge_of[entry] < entry ? 0u : 1u;
  topology.edge_entry.reserve(count);
  topology.edge_vertices.reserve(count);
  topology.edge_cells.reserve(count);
  for (const Cell cell : diagram) {
    for (auto entry = cell.begin(); entry < cell.end(); ++entry) {
      if (edge_of[entry] < entry) {
        edge_of[entry] = edge_of[edge_of[entry]];
        continue;
      }
      edge_of[entry] = static_cast<std::uint32_t>(topology.edge_entry.size());
      topology.edge_entry.push_back(entry);
      topology.edge_vertices.push_back(
          {topology.vertex_of[entry], topology.vertex_of[nextEntry(diagram, cell, entry)]});
      topology.edge_cells.push_back({static_cast<std::int64_t>(cell.index()), diagram.neighbors[entry]});
    }
  }
}

}  // namespace

Result<Topology> topologyOf(const Diagram& diagram, int threads) {
  VORPIPE_TRY(checkArrays(diagram));
  auto distinct = distinctPoints(diagram.vertices);
  if (!distinct) return tl::unexpected(distinct.error());
  Topology topology;
  topology.vertices = std::move(distinct->points);
  topology.vertex_of = std::move(distinct->index_of);
  auto twins = findTwins(diagram, topology.vertex_of, threads);
  if (!twins) return tl::unexpected(twins.error());
  if (!diagram.neighbor_shifts.empty()) joinCopies(diagram, *twins, topology);
  topology.edge_of = std::move(*twins);
  numberEdges(diagram, topology);
  return topology;
}

}  // namespace vorpipe
