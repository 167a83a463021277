#include "io/points/point_feature.h"

namespace vorpipe {
namespace {

Result<void> write(ByteSink& sink, const PointsOutput& output) {
  return writePointFeatures(sink, FeaturesAs::collection, output);
}

}  // namespace

extern const PointsFormat geojson_points;
const PointsFormat geojson_points{.extension = ".geojson", .write = write, .attributes = true};

}  // namespace vorpipe
