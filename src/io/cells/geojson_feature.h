/// The cell of a site as a feature of GeoJSON.
#pragma once

#include <cstddef>

#include "io/cells/cell_records.h"
#include "io/cells/cells_file.h"

namespace vorpipe {

/// Appends a feature: its id is the site, its properties are x, y, weight (where sites have one), status,
/// owner, area, perimeter, centroid and neighbors; mass, mass_centroid and neighbor_shifts where the diagram
/// has them. The geometry is a Polygon, of several pieces a MultiPolygon, or null.
void printFeature(Bytes& text, const CellsOutput& output, std::size_t site);

}  // namespace vorpipe
