/// Vertices where more than three cells meet, or nearly so.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "backend/tie.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

/// How short ties are at each cell. A chain of ties could join vertices that are far apart; there only much
/// shorter edges are ties. An edge is as fine as the finer of its two cells.
class Fineness {
 public:
  /// Each step divides the length of ties by 64; after the last they are as short as rounding errors.
  static constexpr std::uint8_t finest = 5;

  [[nodiscard]] std::uint8_t of(std::size_t cell) const {
    return by_cell_.empty() ? std::uint8_t{0} : by_cell_[cell];
  }
  /// The longest tie between a cell and a neighbor, or a wall, relative to their distance.
  [[nodiscard]] double shortestEdge(std::size_t cell, std::int32_t neighbor) const {
    if (by_cell_.empty()) return shortest_edge;
    const auto there = neighbor < 0 ? std::uint8_t{0} : of(static_cast<std::size_t>(neighbor));
    constexpr int step = 6;
    return std::ldexp(shortest_edge, -step * std::max(of(cell), there));
  }
  /// Makes ties one step finer around these cells; `count` is the number of all cells.
  void increase(const std::vector<std::uint32_t>& cells, std::size_t count) {
    if (by_cell_.empty()) by_cell_.assign(count, 0);
    for (const auto cell : cells) ++by_cell_[cell];
  }

 private:
  std::vector<std::uint8_t> by_cell_;  ///< empty until some cell is finer than others
};

/// What resolveTies does with edges about which their two cells disagree.
enum class Disputes : std::uint8_t { are_listed, are_ties };

/// Joins the corners of the cells marked in `suspect`. Two corners are one vertex if a tie lies between them,
/// or if they are the same end of one edge in its two cells. The vertex is a corner of the domain if two
/// perpendicular walls meet in it. Otherwise it lies at its lowest corner on a wall, so that ties do not pull
/// the domain's border inward. Otherwise it is the power center of three of its sites that are far apart. So
/// it depends on the cells that meet there, not on which ties between them were proposed.
///
/// An edge whose two ends ties join is a tie as well, and so are all edges of cells that ties enclose; see
/// tied_vertices.h. The caller makes ties finer where many of them make a vertex wide. A cell is unsure,
/// but not disputed, if: cells differ about the ends of an edge at a wall, where even edges far shorter than
/// ties count; cells differ about those of an edge that is about as long as a tie, or shorter than rounding;
/// a tie is long relative to the cell; or a vertex is wide.
///
/// Also records the measures of the cells; recordTiedCells adds their numbers of edges.
///
/// Error (input): more than 2^32 - 2 corners.
///
/// Disputed are, first, cells that are not well-formed, empty cells of sites in the domain that no weights
/// hide, and cells that weights leave no area. Second, both cells of an edge longer than a tie that the other
/// cell lacks or has elsewhere. Third, all cells around an edge that is turned around, or is far longer than
/// the ties that join its ends. With Disputes::are_ties, for cells that are exact already, only the first are
/// disputed. Every other edge in dispute is then a tie, in both of its cells.
Result<TiedCells> resolveTies(const ProposedCells& proposed, std::span<const std::uint8_t> suspect,
                              const Fineness& fineness, Disputes disputes, const Records& records);

}  // namespace vorpipe::core
