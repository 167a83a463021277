/// Sites as features of GeoJSON.
#pragma once

#include "io/points/points_file.h"
#include "io/text/geojson_text.h"

namespace vorpipe {

/// Writes a Point for each site: its id is the site, its properties are its weight, where it has one, and the
/// attributes. Error (device): writing failed.
Result<void> writePointFeatures(ByteSink& sink, FeaturesAs as, const PointsOutput& output);

}  // namespace vorpipe
