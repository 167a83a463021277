/// Cells on the whole Earth: see CellsOptions::globe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// The polygons of a cell on the globe, in degrees: each a ring, counter-clockwise, whose first point is not
/// repeated. A cell is cut at longitude 180, and a ring around a pole follows it, as RFC 7946 asks (3.1.9).
/// Edges are great circles, with points in between: half a degree apart or less, so many that straight lines
/// of longitude and latitude are within 1e-5 of the Earth's radius. None for a site without a cell.
std::vector<std::vector<Point>> globePolygons(const Sites& sites, const Diagram& diagram, std::size_t site);

/// Generators of places that are spread evenly over the globe.
enum class GlobePattern : std::uint8_t {
  icosahedral,  ///< a geodesic grid: the corners of an icosahedron, whose faces have k^2 triangles each
  fibonacci,    ///< a spiral by the golden angle
};

/// n places in degrees. A geodesic grid has n = 10 k^2 + 2. Halves of edges are along great circles, other
/// parts are of equal length in the face. Error (input): no grid has n places.
Result<Sites> generateOnGlobe(GlobePattern pattern, std::uint64_t n);

}  // namespace vorpipe
