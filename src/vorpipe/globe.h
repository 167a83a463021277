/// Cells on the whole Earth: see CellsOptions::globe.
#pragma once

#include <cstddef>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/outline.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// An outline on the globe, in degrees, mended as in mendedToPlane(): sides are straight in longitude and
/// latitude, with points added in between, and what a file cuts at longitude 180 or leads to a pole is one
/// again. Errors (input): those of mendedToPlane(); the outline goes around the Earth on all sides.
Result<MendedOutline> mendedOnGlobe(const Outline& degrees, bool repair);

/// The polygons of a cell on the globe, in degrees. A cell is cut at longitude 180, and a ring around a pole follows it, as RFC 7946 asks (3.1.9).
/// Edges are great circles, with points in between: two fifths of a degree apart or less, so many that straight lines
/// of longitude and latitude are within 1e-5 of the Earth's radius. None for a site without a cell.
Outline globePolygons(const Sites& sites, const Diagram& diagram, std::size_t site);

}  // namespace vorpipe
