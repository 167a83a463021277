/// Whether images were enough for the cells of the sites themselves.
#pragma once

#include "core/periodic/images.h"

namespace vorpipe::core {

/// The cells of sites and images, `diagram`, as far as they show which band their sites' own cells need: a
/// cell is right if no image that was left out can lie nearer to one of its vertices v than its site. Along
/// each axis that is so within the site's distance from v, and within half a period of v anyway, because of
/// the images of one site the nearest to v says it all.
///
/// Returns `band` itself if it was enough, else a wider one: if no cell of a site reached the end of the box,
/// one that is enough.
Band bandThatProves(const PeriodicSites& placed, const ImagedSites& imaged, const Diagram& diagram,
                    const Band& band, int threads);

/// Whether every cell that a site's cell meets is the image of a cell of a site. Where all those are right
/// this proves that they fill the domain: a hidden site has no cell far away from itself.
bool isClosed(const ImagedSites& imaged, const Diagram& diagram);

}  // namespace vorpipe::core
