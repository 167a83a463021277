/// Vertices where more than three cells meet, or nearly so.
#pragma once

#include <cstdint>
#include <span>

#include "cells/fineness.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

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
/// The measures of the cells are recorded on the way; their numbers of edges follow (recordTiedCells).
///
/// Error (input): more than 2^32 - 2 corners.
///
/// Disputed are: cells that are not well-formed, empty ones of sites in the domain that no weights hide, and
/// those that weights leave no area; both cells of an edge that is longer than a tie, yet the other cell does
/// not have it, or has it elsewhere; and all cells around an edge that is turned around, or is far longer
/// than the ties that join its ends. With Disputes::are_ties, for cells that are exact already, only the
/// first are: every other edge in dispute is a tie, in both of its cells.
Result<TiedCells> resolveTies(const ProposedCells& proposed, std::span<const std::uint8_t> suspect,
                              const Fineness& fineness, Disputes disputes, const Records& records);

}  // namespace vorpipe::core
