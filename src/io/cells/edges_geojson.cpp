#include "io/cells/edge_feature.h"

namespace vorpipe {
namespace {

Result<void> writeGeojsonEdges(ByteSink& sink, const EdgesOutput& output) {
  return writeEdgeFeatures(sink, FeaturesAs::collection, output);
}

}  // namespace

extern const EdgesFormat geojson_edges;
const EdgesFormat geojson_edges{.extension = ".geojson", .write = writeGeojsonEdges};

}  // namespace vorpipe
