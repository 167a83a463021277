#include "io/cells/cells_file.h"
#include "io/cells/geojson_feature.h"

namespace vorpipe {
namespace {

/// A feature for each site, each on a line of its own.
Result<void> writeGeojsonlCells(ByteSink& sink, const CellsOutput& output) {
  return writeCellFeatures(sink, FeaturesAs::lines, output);
}

}  // namespace

extern const CellsFormat geojsonl_cells;
const CellsFormat geojsonl_cells{.extension = ".geojsonl",
                                 .detail = Detail::polygons,
                                 .write = writeGeojsonlCells,
                                 .attributes = true,
                                 .features = true};

}  // namespace vorpipe
