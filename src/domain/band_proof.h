/// Proves that images were enough for the cells of the sites themselves.
#pragma once

#include "sites/images.h"

namespace vorpipe::core {

/// The band that the cells of the sites need, from the cells of sites and images in `diagram`. A cell is
/// correct if no omitted image can be nearer to one of its vertices v than its site. Images farther from v
/// along an axis than the site's distance cannot be; nor need images farther than half a period be
/// considered, because of the images of one site the nearest to v decides.
///
/// Returns `band` itself if it was enough, else a wider one; that one is enough if no cell of a site reached
/// the end of the box.
Band bandThatProves(const PeriodicSites& placed, const ImagedSites& imaged, const Diagram& diagram,
                    const Band& band, int threads);

/// Whether every neighbor of a site's cell is the image of a cell of a site. Where all those cells are
/// correct, this proves that they fill the domain: no hidden site has a cell far away from itself.
bool isClosed(const ImagedSites& imaged, const Diagram& diagram);

}  // namespace vorpipe::core
