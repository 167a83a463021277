#include "session/box_edges.h"

#include <cmath>

#include "domain/segment_density.h"
#include "session/edge_walk.h"

namespace vorpipe::core {

EdgesOfCells edgesOf(const FoundBox& found, const CellsThatMeet& meet, const DensityPixels* pixels,
                     int threads) {
  EdgesOfCells edges;
  edges.coupling.resize(meet.neighbors.size());
  edges.middle.resize(meet.neighbors.size());
  const SiteSet& sites = found.run->prepared.set;
  const Unscale unscale(found.run->prepared.exponent);
  const auto writeEdge = [&](const WalkedEdge& edge) {
    const Point from = unscale(positionOf(edge.begin)), to = unscale(positionOf(edge.end));
    const auto along = pixels != nullptr ? densityAlong(*pixels, from, to) : SegmentDensity{1, 0.5};
    edges.middle[edge.out] = {from.x + along.center * (to.x - from.x),
                              from.y + along.center * (to.y - from.y)};
    if (edge.neighbor < 0) return;
    const auto other = static_cast<std::size_t>(edge.neighbor);
    const double dx = sites.x[other] - sites.x[edge.cell], dy = sites.y[other] - sites.y[edge.cell];
    const Point way = wayBetween(edge.begin, edge.end);
    edges.coupling[edge.out] =
        along.mean / 2 * std::sqrt((way.x * way.x + way.y * way.y) / (dx * dx + dy * dy));
  };
  walkEdges(found, meet, threads, [&] { return writeEdge; });
  return edges;
}

}  // namespace vorpipe::core
