/// Vertices where more than three cells meet, or nearly so.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/ties/fineness.h"
#include "core/vertices/cell_check.h"

namespace vorpipe::core {

/// Cells at ties, whose vertices do not follow from their own neighbors alone. Corners that ties join are one
/// vertex, with one position. Corner offsets[k] + e is where edge e of cell[k] begins.
struct TiedCells {
  std::vector<std::uint32_t> cell;   ///< ascending
  std::vector<std::uint32_t> entry;  ///< by cell: its index in `cell`, or not_tied; empty without tied cells
  std::vector<std::uint64_t> offsets;   ///< size: tied cells + 1
  std::vector<std::uint32_t> vertex;    ///< of each corner
  std::vector<std::uint8_t> tie;        ///< whether the edge that a corner begins is too short to count
  std::vector<AnchoredPoint> position;  ///< of each vertex
  std::vector<std::uint8_t> walls;      ///< of each vertex; 0: it lies on no wall
  std::vector<std::uint32_t> around_offsets,
      around;                           ///< the tied cells of each vertex, as often as they meet it
  std::vector<std::uint32_t> disputed;  ///< cells with a dispute that no tie explains, ascending; if there
                                        ///< are none, all of this is right
  std::vector<std::uint32_t> enclosed;  ///< cells to be tied as well, since ties enclose them, ascending
  std::vector<std::uint32_t> unsure;    ///< cells to be exact for all of this to be right, ascending
  std::vector<std::uint32_t> wide;      ///< cells that need finer ties, if all are exact, ascending

  static constexpr std::uint32_t not_tied = ~std::uint32_t{0};

  [[nodiscard]] bool has(std::size_t cell_index) const {
    return !entry.empty() && entry[cell_index] != not_tied;
  }
};

/// What resolveTies does with edges about which their two cells disagree.
enum class Disputes : std::uint8_t { are_listed, are_ties };

/// Joins the corners of the cells marked in `suspect`. Two corners are one vertex where a tie lies between
/// them, or where they are ends of the same edge in its two cells. The vertex is a corner of the domain where
/// two perpendicular walls meet in it; else it lies where its lowest corner on a wall is, so that ties do not
/// pull the domain's border inward; else at the power center of three of its sites that are far apart: it
/// depends on the cells that meet there, not on which ties between them were proposed.
///
/// An edge whose two ends ties join is a tie as well, and so are all edges of cells that ties enclose; see
/// collapsed_edges.h. The caller makes ties finer where many of them make a vertex wide. A cell is unsure,
/// but not disputed, where: cells differ about the ends of an edge at a wall, where edges count that are far
/// shorter than ties; or about those of an edge that is about as long as a tie, or shorter than rounding; a
/// tie is long relative to the cell; or a vertex is wide.
///
/// Error (input): more than 2^32 - 2 corners.
///
/// Disputed are: cells that are not well-formed, empty ones of sites in the domain that no weights hide, and
/// those that weights leave no area; both cells of an edge that is longer than a tie, yet the other cell does
/// not have it, or has it elsewhere; and all cells around an edge that is turned around, or is far longer
/// than the ties that join its ends. With Disputes::are_ties, for cells that are exact already, only the
/// first are: every other edge in dispute is a tie, in both of its cells.
Result<TiedCells> resolveTies(const ProposedCells& proposed, std::span<const std::uint8_t> suspect,
                              const Fineness& fineness, Disputes disputes);

/// The edges of tied cell k that are no ties: their indices, beginning with that of the smallest neighbor. A
/// corner after which only ties follow is left out, so that each vertex stands once and begins the edge that
/// it stands with.
void keptEdges(const ProposedCells& proposed, const TiedCells& tied, std::size_t k,
               std::vector<std::uint32_t>& edges);

/// The position where edge e of tied cell k begins.
inline const AnchoredPoint& tiedPosition(const TiedCells& tied, std::size_t k, std::size_t e) {
  return tied.position[tied.vertex[tied.offsets[k] + e]];
}

}  // namespace vorpipe::core
