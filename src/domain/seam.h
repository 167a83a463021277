/// Repairs the seam where the cells of a periodic domain meet across its border.
#pragma once

#include "sites/images.h"

namespace vorpipe::core {

/// Makes the cells of the sites agree across the border. Each edge between a site's cell and an image's has a
/// copy, between the other site's cell and an image of the first. Copies were computed independently: ties
/// may join different corners in them, and an edge may be a tie in only one. Corners that coincide in any
/// copy are made to coincide in all, and the edges between them are removed. Areas and moments do not depend
/// on ties. If all copies agree up to rounding, nothing changes.
///
/// `diagram` has vertices, and only the cells of the sites, whose neighbors are still entries of `imaged`.
/// Returns false, and changes nothing, if copies differ by more than ties explain.
bool settleSeam(const PeriodicSites& placed, const ImagedSites& imaged, Diagram& diagram);

}  // namespace vorpipe::core
