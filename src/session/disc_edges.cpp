#include <cmath>

#include "geometry/polygon_measures.h"
#include "session/disc_cells.h"
#include "session/discs.h"
#include "session/edge_walk.h"

namespace vorpipe::core {
namespace {

/// Writes the parts of edges that lie in discs, for one thread.
class ChordWriter {
 public:
  ChordWriter(const FoundBox& found, const FreeSurface& surface, EdgesOfCells& edges)
      : discs_(found, surface.weight),
        sites_(found.run->prepared.set),
        unscale_(found.run->prepared.exponent),
        edges_(edges) {}

  void operator()(const WalkedEdge& edge) {
    const auto [cell, neighbor, begin, end, out] = edge;
    const auto other = static_cast<std::uint32_t>(neighbor);
    const bool from_other = neighbor >= 0 && discs_.smallerOf(cell, other) == other;
    const Part part = from_other ? partOf(other, static_cast<std::int32_t>(cell), end, begin)
                                 : partOf(cell, neighbor, begin, end);
    edges_.middle[out] = unscale_(part.middle);
    if (neighbor < 0) return;
    const double dx = sites_.x[other] - sites_.x[cell], dy = sites_.y[other] - sites_.y[cell];
    edges_.coupling[out] = part.length / (2 * std::sqrt(dx * dx + dy * dy));
  }

 private:
  struct Part {
    Point middle;
    double length;
  };

  /// Returns the part of the edge to `neighbor` inside the disc of `cell`. Both cells of an edge compute it
  /// in the same way, so that they get the same numbers, to the bit.
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
  const SiteSet& sites_;
  Unscale unscale_;
  EdgesOfCells& edges_;
};

}  // namespace

EdgesOfCells edgesInDiscs(const FoundBox& found, const FreeSurface& surface, const CellsThatMeet& meet,
                          int threads) {
  EdgesOfCells edges;
  edges.coupling.resize(meet.neighbors.size());
  edges.middle.resize(meet.neighbors.size());
  edges.arc = surface.arc;
  walkEdges(found, meet, threads, [&] { return ChordWriter(found, surface, edges); });
  return edges;
}

}  // namespace vorpipe::core
