/// The cells of sites as features of GeoJSON.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/base/geojson_text.h"
#include "io/cells/cells_file.h"

namespace vorpipe {

/// Writes a feature for each site: its id is the site, its properties are x, y, weight (if sites have one),
/// status, owner, area, perimeter, centroid and neighbors; mass, mass_centroid and neighbor_shifts if the
/// diagram has them; then the attributes. The geometry is a Polygon, a MultiPolygon for several pieces, or
/// null. Error (device): writing failed.
Result<void> writeCellFeatures(ByteSink& sink, FeaturesAs as, const CellsOutput& output);

}  // namespace vorpipe
