/// From cells of sites and images to the records of a periodic domain.
#pragma once

#include "sites/images.h"

namespace vorpipe::core {

/// Removes the cells of images from a diagram; neighbors are still entries of `imaged`.
void keepSites(const ImagedSites& imaged, Diagram& diagram);

/// Sets neighbors and shifts, moves every cell to its site, converts all lengths to the caller's units, and
/// removes what `detail` does not request.
void finishRecords(const PeriodicSites& placed, const ImagedSites& imaged, Detail detail, int threads,
                   Diagram& diagram);

}  // namespace vorpipe::core
