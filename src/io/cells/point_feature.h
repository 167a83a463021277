/// Sites as features of GeoJSON.
#pragma once

#include "io/base/geojson_text.h"
#include "io/cells/points_file.h"

namespace vorpipe {

/// Writes a Point for each site: its id is the site, its properties are its weight, if it has one, and the
/// attributes. Error (device): writing failed.
Result<void> writePointFeatures(ByteSink& sink, FeaturesAs as, const PointsOutput& output);

}  // namespace vorpipe
