/// Edges that may be ties, by their lengths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "space/cell_places.h"
#include "space/edge_classes.h"
#include "space/label.h"
#include "space/row_vertices.h"
#include "space/rows.h"

namespace vorpipe::space {

/// Ties are not longer than this part of the least distance between two of the sites around an edge.
constexpr double tie_part = 1e-6;
/// An edge of this part of a tie or less has no length: its ends are one place, rounded twice.
constexpr float no_length = 1e-3F;

/// An edge that is not longer than a tie between three of its labels: two sites at least, or a site and
/// walls.
struct ShortEdge {
  Label site;                          ///< the least whose cell was asked
  std::uint32_t edge_end, end_before;  ///< of its row; see RowVertices
  float part;                          ///< its length in such ties, at most 1
};

/// What stands around an edge end of a row: the edge lies between faces `face` and `other`, and leads from a
/// vertex with face `before` to one with face `after`.
struct EdgeAround {
  std::size_t face, other, before, after;
};
EdgeAround edgeAround(const Row& row, std::size_t edge_end);
/// The labels around the edge.
EdgeLabels labelsAround(const Row& row, Label site, std::size_t edge_end);

/// The longest tie between these labels, one of which is a site: what the distance of two sites or, with a
/// wall, the shortest side of the box allows.
double tieOf(const Places& places, const EdgeLabels& labels);

/// The length of an edge, in ties between three of its labels.
double lengthInTies(const Places& places, const Rows& rows, const ShortEdge& edge, double fine);

/// All short edges of the cells of these sites (those with rows, ascending), each once, in their order.
std::vector<ShortEdge> shortEdges(const Places& places, const Rows& rows,
                                  std::span<const std::uint32_t> sites, int threads);

}  // namespace vorpipe::space
