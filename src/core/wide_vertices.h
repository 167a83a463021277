/// Vertices that ties in a row make wide.
#pragma once

#include "core/ties.h"

namespace vorpipe {

/// Where a corner that ties have joined to a vertex is farther from its place than two or four times the
/// longest tie there may be long.
WideVertices findWideVertices(const ProposedCells& proposed, const TiedCells& tied, const Fineness& fineness);

}  // namespace vorpipe
