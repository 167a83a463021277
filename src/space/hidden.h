/// Proofs that sites have no cell.
#pragma once

#include <array>

#include "space/label.h"

namespace vorpipe::space {

/// Four half-spaces of a site, of other sites or walls, that have no point in common: the first three meet in
/// a vertex, which the fourth cuts off and with it all that these leave. Where fewer do it the others are
/// any.
using NoCell = std::array<Label, 4>;

/// Whether they leave nothing of the cell of a site, by exact signs. Ties are broken as cuts() does.
bool leaveNothing(const Places& places, Label site, const NoCell& of);

/// The same of a vertex that the fourth is known to cut off, whose first three turn counter-clockwise.
bool isNearestVertex(const Places& places, Label site, const NoCell& of);

}  // namespace vorpipe::space
