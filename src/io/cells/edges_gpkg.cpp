#include "io/base/geopackage.h"
#include "io/cells/edges_file.h"

namespace vorpipe {
namespace {

/// A GeoPackage with the layer `edges`, of LineStrings.
Result<void> writeGpkgEdges(ByteSink& sink, const EdgesOutput& output) {
  const Layer layer{"edges",
                    GeometryType::line_string,
                    {{"edge", FieldType::integer},
                     {"site_a", FieldType::integer},
                     {"site_b", FieldType::integer},
                     {"length", FieldType::real}},
                    output.system};
  Wkb wkb;
  return writeGeoPackage(sink, layer, output.topology.edge_entry.size(),
                         [&](std::size_t edge, FeatureRow& row) {
                           const EdgeLine line = edgeLine(output, edge);
                           wkb.clear();
                           wkb.begin(GeometryType::line_string, 2);
                           wkb.add(line.begin);
                           wkb.add(line.end);
                           row.setGeometry(wkb);
                           row.add(static_cast<std::int64_t>(edge));
                           row.add(line.site_a);
                           row.add(line.site_b);
                           row.add(line.length);
                           return true;
                         });
}

}  // namespace

extern const EdgesFormat gpkg_edges;
const EdgesFormat gpkg_edges{.extension = ".gpkg", .write = writeGpkgEdges, .in_memory = true};

}  // namespace vorpipe
