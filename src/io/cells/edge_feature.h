/// Edges as features of GeoJSON.
#pragma once

#include "io/base/geojson_text.h"
#include "io/cells/edges_file.h"

namespace vorpipe {

/// Writes a feature for each edge: its id is the edge, its properties are edge, site_a, site_b and length,
/// its geometry is a LineString. Error (device): writing failed.
inline Result<void> writeEdgeFeatures(ByteSink& sink, FeaturesAs as, const EdgesOutput& output) {
  const auto put = [&](Bytes& text, std::size_t edge) {
    const EdgeLine line = edgeLine(output, edge);
    print(text,
          FMT_COMPILE(
              R"({{"type":"Feature","id":{0},"properties":{{"edge":{0},"site_a":{1},"site_b":{2},)"
              R"("length":{3}}},"geometry":{{"type":"LineString","coordinates":[[{4},{5}],[{6},{7}]]}}}})"),
          edge, line.site_a, line.site_b, line.length, line.begin.x, line.begin.y, line.end.x, line.end.y);
    return true;
  };
  return writeFeatures(sink, as, output.topology.edge_entry.size(), put, output.threads);
}

}  // namespace vorpipe
