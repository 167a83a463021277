/// Longitudes of cells that lie on the meridian opposite to the center of a projection.
#pragma once

#include <cstddef>

#include "vorpipe.h"

namespace vorpipe::core {

/// Makes the longitudes of a cell, which are within a half turn of the center's, continuous along its rings.
/// They are then in the turn in which the cell contains its site of longitude `site`, if there is one; its
/// centroids move along. A ring around a pole stays as it is: one of its edges leads from one side of that
/// meridian to the other.
void joinTurns(double site, std::size_t cell, Diagram& diagram);

}  // namespace vorpipe::core
