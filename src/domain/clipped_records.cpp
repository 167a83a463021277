#include "domain/clipped_records.h"

#include <utility>

#include "base/parallel.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t clipped_records_grain = 4096;

/// Replacements of a diagram's arrays that have an element for each edge.
struct EdgeArrays {
  std::vector<std::uint64_t> cell_offsets, ring_starts;
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;
  std::vector<double> edge_lengths;
};

/// Writes the records of clipped cells, whose edges are sorted: those by edge into new arrays, those by site
/// over the old ones.
class ClippedWriter {
 public:
  ClippedWriter(const ScaledDiagram& cells, const ClippedCells& clipped, EdgeArrays& to, Diagram& diagram)
      : cells_(cells), clipped_(clipped), to_(to), diagram_(diagram) {}

  /// Writes the records of site i; `first_ring` is the number of its first ring among all.
  void cell(std::size_t i, std::size_t first_ring) {
    switch (clipped_.fate[i]) {
      case Fate::inside:
        keep(i, first_ring);
        break;
      case Fate::cut:
        replace(i, *clipped_.parts[i], first_ring);
        break;
      case Fate::outside:
        diagram_.status[i] = Status::empty;
        diagram_.area[i] = diagram_.perimeter[i] = 0;
        diagram_.second_moments[i] = {};
        diagram_.centroid[i] = cells_.givenSite(i);
        break;
      case Fate::none:
        break;
    }
  }

 private:
  void keep(std::size_t i, std::size_t first_ring) {
    std::size_t out = to_.cell_offsets[i];
    if (out == to_.cell_offsets[i + 1]) return;
    to_.ring_starts[first_ring] = out;
    for (std::size_t e = cells_.begin(i); e < cells_.end(i); ++e) {
      if (cells_.isPoint(i, e)) continue;
      to_.vertices[out] = diagram_.vertices[e];
      to_.edge_lengths[out] = diagram_.edge_lengths[e];
      const std::int64_t neighbor = diagram_.neighbors[e];
      const bool both_inside =
          neighbor < 0 || clipped_.fate[static_cast<std::size_t>(neighbor)] == Fate::inside;
      to_.neighbors[out++] =
          both_inside ? neighbor : label(i, neighbor, cells_.vertex(e), cells_.vertex(cells_.next(i, e)));
    }
  }

  void replace(std::size_t i, const ClippedCell& cell, std::size_t first_ring) {
    double perimeter = 0;
    const std::size_t out = to_.cell_offsets[i];
    for (std::size_t r = 0; r < cell.ring_starts.size(); ++r) {
      const auto ring = cell.ring(r);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point a = ring[k], b = nextOf(ring, k);
        const std::size_t e = cell.ring_starts[r] + k;
        const double length = lengthOf({b.x - a.x, b.y - a.y});
        perimeter += length;
        to_.vertices[out + e] = cells_.unscaled(a);
        to_.edge_lengths[out + e] = cells_.unscaled(length);
        to_.neighbors[out + e] = label(i, cell.neighbors[e], a, b);
      }
      to_.ring_starts[first_ring + r] = out + cell.ring_starts[r];
    }
    diagram_.perimeter[i] = cells_.unscaled(perimeter);
  }

  /// The final neighbor of cell i across the edge from a to b; clipping labeled it `neighbor`.
  [[nodiscard]] std::int64_t label(std::size_t i, std::int64_t neighbor, Point a, Point b) const {
    if (neighbor >= 0 && !isCommon(i, static_cast<std::size_t>(neighbor), a, b)) neighbor = wall_outline;
    if (neighbor != wall_outline) return neighbor;
    const Box& box = cells_.domain();
    if (a.x == b.x && (a.x == box.xmin || a.x == box.xmax)) return a.x == box.xmin ? wall_xmin : wall_xmax;
    if (a.y == b.y && (a.y == box.ymin || a.y == box.ymax)) return a.y == box.ymin ? wall_ymin : wall_ymax;
    return wall_outline;
  }

  /// Whether cell i had an edge with cell j from a to b before it was clipped.
  [[nodiscard]] bool hadEdge(std::size_t i, std::size_t j, Point a, Point b) const {
    for (std::size_t e = cells_.begin(i); e < cells_.end(i); ++e) {
      const bool there = cells_.vertex(e) == a && cells_.vertex(cells_.next(i, e)) == b;
      if (there && cells_.neighbor(e) == static_cast<std::int64_t>(j)) return true;
    }
    return false;
  }

  /// The same for either cell, trying the one with fewer edges first. An edge of one is an edge of the other
  /// from b to a, unless ties joined its end to a wall.
  [[nodiscard]] bool hadCommonEdge(std::size_t i, std::size_t j, Point a, Point b) const {
    const bool fewer = cells_.end(i) - cells_.begin(i) <= cells_.end(j) - cells_.begin(j);
    return fewer ? hadEdge(i, j, a, b) || hadEdge(j, i, b, a) : hadEdge(j, i, b, a) || hadEdge(i, j, a, b);
  }

  /// Whether a part of an edge between cells i and j, from a to b, is a tie.
  [[nodiscard]] bool isTie(std::size_t i, std::size_t j, Point a, Point b) const {
    const Point p = cells_.site(i), q = cells_.site(j);
    const double scale = tieScale(lengthOf({q.x - p.x, q.y - p.y}), shorterSide(cells_.domain()));
    return lengthOf({b.x - a.x, b.y - a.y}) <= shortest_edge * scale;
  }

  /// Whether the edge of cell i from a to b is also an edge of cell j, from b to a, and not a tie. Whole
  /// edges that are ties are gone already.
  [[nodiscard]] bool isCommon(std::size_t i, std::size_t j, Point a, Point b) const {
    if (isTie(i, j, a, b) && !hadCommonEdge(i, j, a, b)) return false;
    if (clipped_.fate[j] == Fate::inside) return hadCommonEdge(i, j, a, b);
    return clipped_.fate[j] == Fate::cut && clipped_.parts[j]->hasEdge(static_cast<std::int64_t>(i), b, a);
  }

  const ScaledDiagram& cells_;
  const ClippedCells& clipped_;
  EdgeArrays& to_;
  Diagram& diagram_;
};

struct Counts {
  std::uint64_t edges, rings;
};

Counts countsOf(const ScaledDiagram& cells, const ClippedCells& clipped, std::size_t i) {
  if (clipped.fate[i] == Fate::inside) {
    std::uint64_t edges = 0;
    for (std::size_t e = cells.begin(i); e < cells.end(i); ++e) edges += cells.isPoint(i, e) ? 0U : 1U;
    return {edges, edges > 0 ? 1U : 0U};
  }
  if (clipped.fate[i] == Fate::cut)
    return {clipped.parts[i]->vertices.size(), clipped.parts[i]->ring_starts.size()};
  return {0, 0};
}

}  // namespace

ScaledDiagram::ScaledDiagram(const ClippedRun& run, const Diagram& diagram)
    : run_(run),
      diagram_(diagram),
      scale_(-run.exponent),
      unscale_(run.exponent),
      domain_{scale_(run.domain.xmin), scale_(run.domain.ymin), scale_(run.domain.xmax),
              scale_(run.domain.ymax)} {}

void ScaledDiagram::appendCell(std::size_t site, std::vector<Point>& vertices,
                               std::vector<std::int64_t>& neighbors) const {
  const std::size_t first = begin(site), last = end(site);
  if (first == last) return;
  Point here = vertex(first);
  const Point start = here;
  for (std::size_t e = first; e < last; ++e) {
    const Point next = e + 1 < last ? vertex(e + 1) : start;
    if (here != next) {
      vertices.push_back(here);
      neighbors.push_back(diagram_.neighbors[e]);
    }
    here = next;
  }
}

void writeClipped(const ScaledDiagram& cells, const ClippedCells& clipped, Diagram& diagram) {
  const std::size_t count = cells.size();
  EdgeArrays arrays;
  arrays.cell_offsets.assign(count + 1, 0);
  std::vector<std::uint64_t> first_ring(count + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const Counts counts = countsOf(cells, clipped, i);
    arrays.cell_offsets[i + 1] = arrays.cell_offsets[i] + counts.edges;
    first_ring[i + 1] = first_ring[i] + counts.rings;
  }
  arrays.ring_starts.resize(first_ring.back());
  arrays.vertices.resize(arrays.cell_offsets.back());
  arrays.neighbors.resize(arrays.cell_offsets.back());
  arrays.edge_lengths.resize(arrays.cell_offsets.back());
  parallelFor(count, clipped_records_grain, cells.threads(), [&](std::size_t begin, std::size_t end) {
    ClippedWriter writer(cells, clipped, arrays, diagram);
    for (std::size_t i = begin; i < end; ++i) writer.cell(i, first_ring[i]);
  });
  diagram.cell_offsets = std::move(arrays.cell_offsets);
  diagram.ring_starts = std::move(arrays.ring_starts);
  diagram.vertices = std::move(arrays.vertices);
  diagram.neighbors = std::move(arrays.neighbors);
  diagram.edge_lengths = std::move(arrays.edge_lengths);
}

}  // namespace vorpipe::core
