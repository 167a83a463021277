/// Vertices that ties in a row make wide.
#pragma once

#include "core/ties/ties.h"

namespace vorpipe::core {

/// The cells around wide vertices, ascending, without those whose ties are as fine as can be.
struct WideVertices {
  std::vector<std::uint32_t> nearly;  ///< a vertex is wide, or might be if its cells were exact
  std::vector<std::uint32_t> quite;   ///< these need finer ties, if all of them are exact
};

/// Where a corner that ties have joined to a vertex is farther from its place than the check of polygons
/// allows, or half as far.
WideVertices findWideVertices(const ProposedCells& proposed, const TiedCells& tied, const Fineness& fineness);

}  // namespace vorpipe::core
