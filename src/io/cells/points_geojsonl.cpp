#include "io/cells/point_feature.h"

namespace vorpipe {
namespace {

Result<void> writeGeojsonlPoints(ByteSink& sink, const PointsOutput& output) {
  return writePointFeatures(sink, FeaturesAs::lines, output);
}

}  // namespace

extern const PointsFormat geojsonl_points;
const PointsFormat geojsonl_points{
    .extension = ".geojsonl", .write = writeGeojsonlPoints, .attributes = true};

}  // namespace vorpipe
