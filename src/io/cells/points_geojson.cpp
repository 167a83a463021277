#include "io/cells/point_feature.h"

namespace vorpipe {
namespace {

Result<void> writeGeojsonPoints(ByteSink& sink, const PointsOutput& output) {
  return writePointFeatures(sink, FeaturesAs::collection, output);
}

}  // namespace

extern const PointsFormat geojson_points;
const PointsFormat geojson_points{.extension = ".geojson", .write = writeGeojsonPoints, .attributes = true};

}  // namespace vorpipe
