/// Vertices that chains of ties make wide.
#pragma once

#include "cells/fineness.h"
#include "cells/tied_cells.h"

namespace vorpipe::core {

/// The cells around wide vertices, ascending, except those whose ties are already the finest.
struct WideVertices {
  std::vector<std::uint32_t> nearly;  ///< a vertex is wide, or might be if its cells were exact
  std::vector<std::uint32_t> quite;   ///< these need finer ties, if all of them are exact
};

/// A vertex is wide where one of the corners that ties joined is farther from it than `--check` allows for
/// polygons, and nearly wide at half of that.
WideVertices findWideVertices(const ProposedCells& proposed, const TiedCells& tied, const Fineness& fineness);

}  // namespace vorpipe::core
