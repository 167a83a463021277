/// Shared parts of the polygons of a Diagram: vertices, and edges between two cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe/cell.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"
#include "vorpipe/wall.h"

namespace vorpipe {

/// A list of points without repetitions.
struct DistinctPoints {
  std::vector<Point> points;            ///< in the order in which they first occur
  std::vector<std::uint32_t> index_of;  ///< by given point
};

/// Merges points with equal coordinates; moves none. Error (input): there are more than 2^32 - 2.
Result<DistinctPoints> distinctPoints(std::span<const Point> points);

/// The vertices and edges of a Diagram, each once. An *entry* is an index into Diagram::vertices and into the
/// arrays that are as long as that: vertex k of a cell, its edge k, and the neighbor across that.
///
/// A vertex is a position: its coordinates equal those in the cells to the last bit. In a periodic domain it
/// also stands for all of its copies: vertices are copies of each other if edges that have them as ends are.
/// A tie is one vertex, at which more than three cells meet. Rings of an outline that touch in a point share
/// it. If coordinates are too coarse for a cell, its vertices may coincide, and edges may begin and end at
/// the same one.
struct Topology {
  std::vector<Point> vertices;           ///< in the order of entries; at the position of the first copy
  std::vector<std::uint32_t> vertex_of;  ///< by entry

  /// By edge, in the order of entries: its entry in the first of its cells.
  std::vector<std::uint64_t> edge_entry;
  /// Its first and last vertex, counter-clockwise around the first of its cells; clockwise around a hole.
  std::vector<std::array<std::uint32_t, 2>> edge_vertices;
  /// The cells on its left and right. The first is a site; the second is a site of higher index, a wall, or
  /// in a periodic domain the first site itself. Along an outline two cells may share several edges.
  std::vector<std::array<std::int64_t, 2>> edge_cells;
  std::vector<std::uint32_t> edge_of;  ///< by entry

  /// Whether an edge is part of the domain's border or of its outline.
  [[nodiscard]] bool isBoundary(std::size_t edge) const { return isWall(edge_cells[edge][1]); }

  /// The vertices and the edges of a cell of the same diagram, in the cell's order.
  [[nodiscard]] std::span<const std::uint32_t> verticesOf(const Cell& cell) const {
    return std::span(vertex_of).subspan(cell.begin(), cell.edges());
  }
  [[nodiscard]] std::span<const std::uint32_t> edgesOf(const Cell& cell) const {
    return std::span(edge_of).subspan(cell.begin(), cell.edges());
  }
};

/// Finds the shared vertices and edges. Errors (input): the diagram has neighbors but no vertices, as with
/// Detail::measures; it has more than 2^32 - 2 entries; two cells disagree about their common edges.
Result<Topology> topologyOf(const Diagram& diagram, int threads = 0);

/// Two sites, the lower index first.
using SitePair = std::array<std::uint32_t, 2>;

/// Returns the edges of the triangulation of the sites of a diagram with triangles, ascending, each once.
/// Where all sites lie on a line, which leaves no triangles, those that follow each other are pairs.
std::vector<SitePair> triangulationEdges(const Sites& sites, const Diagram& diagram);

}  // namespace vorpipe
