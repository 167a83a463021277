/// Where the cells of a periodic domain meet across its border.
#pragma once

#include "core/periodic/images.h"

namespace vorpipe::core {

/// Makes the cells of the sites agree across the border. Each edge between a site's cell and an image's
/// has a copy, between the other site's cell and an image of the first; copies were found apart, and which
/// ties joined which corners may differ between them, and with it whether an edge is a tie. Corners that
/// are one in any copy become one in all, and edges between them go. Areas and moments do not depend on
/// ties. Where all copies agree to rounding, nothing changes.
///
/// `diagram` has vertices, and of cells those of the sites alone, whose neighbors are still entries of
/// `imaged`. Returns false, and changes nothing, where copies differ by more than ties may explain.
bool settleSeam(const PeriodicSites& placed, const ImagedSites& imaged, Diagram& diagram);

}  // namespace vorpipe::core
