#include "session/cell_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "cells/cell_walk.h"
#include "domain/density_pixels.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

/// One edge, and the index of its values in CellsThatMeet.
struct WalkedEdge {
  std::uint32_t cell;
  std::int32_t neighbor;
  const AnchoredPoint &begin, &end;  ///< corners before ties join them
  std::uint64_t out;
};

/// Calls take(edge) for each edge of cells that findMoments() found, except those that ties remove. It runs
/// on several threads; each has its own `take` from makeTaker(). `meet` is the result of neighborsOf() for
/// the cells.
template <class MakeTaker>
void walkEdges(const FoundBox& found, const CellsThatMeet& meet, int threads, const MakeTaker& makeTaker) {
  constexpr std::size_t grain = 4096;
  const SiteSet& set = found.run->prepared.set;
  const NeighborRows& cells = found.cells->rows;
  const TiedCells& tied = found.cells->tied;
  const EdgeIndex index(cells, threads);
  const ProposedCells proposed{set, cells, index, threads};
  parallelFor(set.size(), grainFor(set.size(), grain), threads, [&](std::size_t first, std::size_t last) {
    auto take = makeTaker();
    CellWalk walk(set, cells);
    std::vector<std::uint32_t> kept;
    walk(first, last, [&](std::uint32_t cell, auto row, auto corners) {
      auto out = meet.offsets[set.id[cell]];
      const auto takeEdge = [&](std::size_t e) {
        take(WalkedEdge{cell, row[e], corners[e], corners[e + 1 < row.size() ? e + 1 : 0], out++});
      };
      if (!tied.has(cell)) {
        for (std::size_t e = 0; e < row.size(); ++e) takeEdge(e);
        return;
      }
      keptEdges(proposed, tied, tied.entry[cell], kept);
      for (const auto e : kept) takeEdge(e);
    });
  });
}

}  // namespace

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

namespace {

/// Calls take(v, next) with the first and last vertex of each edge of a cell, whose vertices are begin to end
/// - 1. `ring_starts` is that of the diagram.
template <class Take>
void eachEdge(std::span<const std::uint64_t> ring_starts, std::uint64_t begin, std::uint64_t end,
              const Take& take) {
  auto start = std::ranges::upper_bound(ring_starts, begin);
  for (auto ring = begin; ring < end;) {
    const auto next = start != ring_starts.end() ? std::min(*start++, end) : end;
    for (auto v = ring; v < next; ++v) take(v, v + 1 < next ? v + 1 : ring);
    ring = next;
  }
}

constexpr std::size_t polygon_edges_grain = 4096;

class PolygonEdges {
 public:
  PolygonEdges(const CellPolygons& polygons, const CellsThatMeet& meet, const PolygonScene& scene,
               EdgesOfCells& edges)
      : polygons_(polygons),
        meet_(meet),
        places_(scene.places),
        width_(scene.domain.xmax - scene.domain.xmin),
        height_(scene.domain.ymax - scene.domain.ymin),
        edges_(edges) {
    if (!scene.density.values.empty()) pixels_.emplace(scene.density, scene.domain, scene.periodic);
  }

  void cell(std::size_t i) const {
    eachEdge(polygons_.ring_starts, meet_.offsets[i], meet_.offsets[i + 1],
             [&](std::uint64_t v, std::uint64_t next) { edge(i, v, next); });
  }

 private:
  void edge(std::size_t i, std::uint64_t v, std::uint64_t next) const {
    const Point a = polygons_.vertices[v], b = polygons_.vertices[next];
    const SegmentDensity along = pixels_ ? densityAlong(*pixels_, a, b) : SegmentDensity{1, 0.5};
    edges_.middle[v] = {a.x + along.center * (b.x - a.x), a.y + along.center * (b.y - a.y)};
    if (meet_.neighbors[v] < 0) return;
    edges_.coupling[v] = along.mean * polygons_.edge_lengths[v] / (2 * distance(i, v));
  }

  /// Returns the distance from the site of cell i to the one on the other side of edge v, or to its image.
  [[nodiscard]] double distance(std::size_t i, std::uint64_t v) const {
    const auto j = static_cast<std::size_t>(meet_.neighbors[v]);
    Point way{places_.x[j] - places_.x[i], places_.y[j] - places_.y[i]};
    if (!meet_.shifts.empty()) {
      way.x += meet_.shifts[v][0] * width_;
      way.y += meet_.shifts[v][1] * height_;
    }
    return lengthOf(way);
  }

  const CellPolygons& polygons_;
  const CellsThatMeet& meet_;
  const Sites& places_;
  double width_, height_;  ///< of the domain
  std::optional<DensityPixels> pixels_;
  EdgesOfCells& edges_;
};

}  // namespace

EdgesOfCells edgesOf(const CellPolygons& polygons, const CellsThatMeet& meet, const PolygonScene& scene) {
  EdgesOfCells edges;
  edges.coupling.resize(meet.neighbors.size());
  edges.middle.resize(meet.neighbors.size());
  const PolygonEdges writer(polygons, meet, scene, edges);
  const std::size_t cells = meet.offsets.size() - 1;
  parallelEach(cells, grainFor(cells, polygon_edges_grain), scene.threads,
               [&](std::size_t i) { writer.cell(i); });
  return edges;
}

}  // namespace vorpipe::core
