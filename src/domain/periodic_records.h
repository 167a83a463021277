/// From cells of sites and images to those of a periodic domain: proof, repair, records.
#pragma once

#include "sites/images.h"

namespace vorpipe::core {

/// Returns the band that the cells of the sites need, computed from the cells of sites and images in
/// `diagram`. A cell is correct if no omitted image can be nearer to one of its vertices v than its site. An
/// image farther from v along an axis than the site's distance cannot be nearer. Images farther than half a
/// period do not matter either: of one site's images the nearest to v decides.
///
/// Returns `band` itself if it sufficed, else a wider one. The wider one suffices if no cell of a site
/// reached the end of the box.
Band bandThatProves(const PeriodicSites& placed, const ImagedSites& imaged, const Diagram& diagram,
                    const Band& band, int threads);

/// Whether every neighbor of a site's cell is the image of a site with a cell. If all those cells are
/// correct, this proves that they fill the domain: no hidden site has a cell far away from itself.
bool isClosed(const ImagedSites& imaged, const Diagram& diagram);

/// Removes the cells of images from a diagram; neighbors are still entries of `imaged`.
void keepSites(const ImagedSites& imaged, Diagram& diagram);

/// Sets neighbors and shifts, moves every cell to its site, converts all lengths to the caller's units, and
/// removes what `detail` does not request.
void finishRecords(const PeriodicSites& placed, const ImagedSites& imaged, Detail detail, int threads,
                   Diagram& diagram);

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
