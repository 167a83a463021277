#include "io/cells/edge_feature.h"

namespace vorpipe {
namespace {

Result<void> writeGeojsonlEdges(ByteSink& sink, const EdgesOutput& output) {
  return writeEdgeFeatures(sink, FeaturesAs::lines, output);
}

}  // namespace

extern const EdgesFormat geojsonl_edges;
const EdgesFormat geojsonl_edges{.extension = ".geojsonl", .write = writeGeojsonlEdges};

}  // namespace vorpipe
