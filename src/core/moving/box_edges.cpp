#include "core/moving/box_edges.h"

#include <cmath>

#include "base/parallel.h"
#include "core/cells/segment_density.h"
#include "core/vertices/cell_walk.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 4096;

/// Writes the edges of cells, in the order of the set.
class CouplingWriter {
 public:
  CouplingWriter(const FoundBox& found, const ProposedCells& proposed, const CellsThatMeet& meet,
                 const DensityPixels* pixels, EdgesOfCells& edges)
      : proposed_(proposed),
        tied_(found.cells->tied),
        unscale_(found.run->prepared.exponent),
        meet_(meet),
        pixels_(pixels),
        edges_(edges) {}

  void write(std::uint32_t cell, std::span<const std::int32_t> row, std::span<const AnchoredPoint> corners) {
    auto out = meet_.offsets[proposed_.sites.id[cell]];
    if (!tied_.has(cell)) {
      for (std::size_t e = 0; e < row.size(); ++e) writeEdge(cell, row, corners, e, out++);
      return;
    }
    keptEdges(proposed_, tied_, tied_.entry[cell], kept_);
    for (const auto e : kept_) writeEdge(cell, row, corners, e, out++);
  }

 private:
  void writeEdge(std::uint32_t cell, std::span<const std::int32_t> row,
                 std::span<const AnchoredPoint> corners, std::size_t e, std::uint64_t out) {
    const AnchoredPoint &begin = corners[e], &end = corners[e + 1 < row.size() ? e + 1 : 0];
    const Point from = unscale_(positionOf(begin)), to = unscale_(positionOf(end));
    const auto along = pixels_ != nullptr ? densityAlong(*pixels_, from, to) : SegmentDensity{1, 0.5};
    edges_.middle[out] = {from.x + along.center * (to.x - from.x), from.y + along.center * (to.y - from.y)};
    const std::int32_t neighbor = row[e];
    if (neighbor < 0) return;
    const SiteSet& sites = proposed_.sites;
    const auto other = static_cast<std::size_t>(neighbor);
    const double dx = sites.x[other] - sites.x[cell], dy = sites.y[other] - sites.y[cell];
    const Point way = wayBetween(begin, end);
    edges_.coupling[out] = along.mean / 2 * std::sqrt((way.x * way.x + way.y * way.y) / (dx * dx + dy * dy));
  }

  const ProposedCells& proposed_;
  const TiedCells& tied_;
  Unscale unscale_;
  const CellsThatMeet& meet_;
  const DensityPixels* pixels_;
  EdgesOfCells& edges_;
  std::vector<std::uint32_t> kept_;
};

}  // namespace

EdgesOfCells edgesOf(const FoundBox& found, const CellsThatMeet& meet, const DensityPixels* pixels,
                     int threads) {
  EdgesOfCells edges;
  edges.coupling.resize(meet.neighbors.size());
  edges.middle.resize(meet.neighbors.size());
  const SiteSet& set = found.run->prepared.set;
  const NeighborRows& cells = found.cells->rows;
  const EdgeIndex index(cells, threads);
  const ProposedCells proposed{set, cells, index, threads};
  parallelFor(set.size(), grainFor(set.size(), grain), threads, [&](std::size_t begin, std::size_t end) {
    CouplingWriter writer(found, proposed, meet, pixels, edges);
    CellWalk walk(set, cells);
    walk(begin, end, [&](std::uint32_t cell, auto row, auto corners) { writer.write(cell, row, corners); });
  });
  return edges;
}

}  // namespace vorpipe::core
