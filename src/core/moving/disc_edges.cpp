#include <cmath>

#include "base/parallel.h"
#include "core/geometry/polygon_measures.h"
#include "core/moving/disc_cells.h"
#include "core/moving/discs.h"
#include "core/vertices/cell_walk.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t grain = 4096;

/// Writes the parts of edges that lie in discs, in the order of the set, for one thread.
class ChordWriter {
 public:
  ChordWriter(const FoundBox& found, const FreeSurface& surface, const ProposedCells& proposed,
              const CellsThatMeet& meet, EdgesOfCells& edges)
      : discs_(found, surface.weight),
        proposed_(proposed),
        tied_(found.cells->tied),
        unscale_(found.run->prepared.exponent),
        meet_(meet),
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
    const std::int32_t neighbor = row[e];
    const auto other = static_cast<std::uint32_t>(neighbor);
    const bool from_other = neighbor >= 0 && discs_.smallerOf(cell, other) == other;
    const Part part = from_other ? partOf(other, static_cast<std::int32_t>(cell), end, begin)
                                 : partOf(cell, neighbor, begin, end);
    edges_.middle[out] = unscale_(part.middle);
    if (neighbor < 0) return;
    const SiteSet& sites = proposed_.sites;
    const double dx = sites.x[other] - sites.x[cell], dy = sites.y[other] - sites.y[cell];
    edges_.coupling[out] = part.length / (2 * std::sqrt(dx * dx + dy * dy));
  }

  struct Part {
    Point middle;
    double length;
  };

  /// What the disc of `cell` has of its edge to `neighbor`. Both cells of an edge ask for it in the same way,
  /// so that they get the same numbers, to the bit.
  [[nodiscard]] Part partOf(std::uint32_t cell, std::int32_t neighbor, const AnchoredPoint& begin,
                            const AnchoredPoint& end) const {
    const Point site = discs_.siteOf(cell);
    const double squared_radius = discs_.squaredRadius(cell);
    const EdgeEnd first = endAt(relativeTo(site, begin), squared_radius);
    const EdgeEnd last = endAt(relativeTo(site, end), squared_radius);
    const Point way = wayBetween(begin, end), from = positionOf(begin);
    const Point middle{from.x + way.x / 2, from.y + way.y / 2};
    if (first.inside && last.inside) return {middle, lengthOf(way)};
    if (!(squared_radius > 0)) return {middle, 0};
    const Chord chord = chordOf(discs_.lineOf(cell, neighbor), first, last, squared_radius);
    if (!chord.is_there) return {middle, 0};
    return {{site.x + (chord.from.x + chord.to.x) / 2, site.y + (chord.from.y + chord.to.y) / 2},
            chord.length};
  }

  Discs discs_;
  const ProposedCells& proposed_;
  const TiedCells& tied_;
  Unscale unscale_;
  const CellsThatMeet& meet_;
  EdgesOfCells& edges_;
  std::vector<std::uint32_t> kept_;
};

}  // namespace

EdgesOfCells edgesInDiscs(const FoundBox& found, const FreeSurface& surface, const CellsThatMeet& meet,
                          int threads) {
  EdgesOfCells edges;
  edges.coupling.resize(meet.neighbors.size());
  edges.middle.resize(meet.neighbors.size());
  edges.arc = surface.arc;
  const SiteSet& set = found.run->prepared.set;
  const NeighborRows& cells = found.cells->rows;
  const EdgeIndex index(cells, threads);
  const ProposedCells proposed{set, cells, index, threads};
  parallelFor(set.size(), grainFor(set.size(), grain), threads, [&](std::size_t begin, std::size_t end) {
    ChordWriter writer(found, surface, proposed, meet, edges);
    CellWalk walk(set, cells);
    walk(begin, end, [&](std::uint32_t cell, auto row, auto corners) { writer.write(cell, row, corners); });
  });
  return edges;
}

}  // namespace vorpipe::core
