#include "io/cells/cells_file.h"
#include "io/cells/geojson_feature.h"

namespace vorpipe {
namespace {

/// A FeatureCollection, with a feature for each site.
Result<void> writeGeojsonCells(ByteSink& sink, const CellsOutput& output) {
  return writeCellFeatures(sink, FeaturesAs::collection, output);
}

}  // namespace

extern const CellsFormat geojson_cells;
const CellsFormat geojson_cells{.extension = ".geojson",
                                .detail = Detail::polygons,
                                .write = writeGeojsonCells,
                                .attributes = true,
                                .features = true};

}  // namespace vorpipe
