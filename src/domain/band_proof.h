/// Proves that the images sufficed for the cells of the sites.
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

}  // namespace vorpipe::core
