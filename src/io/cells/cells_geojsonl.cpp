#include "io/cells/cells_file.h"
#include "io/cells/geojson_feature.h"

namespace vorpipe {
namespace {

/// A feature for each site, each on a line of its own (GeoJSONSeq without record separators, as GDAL, PostGIS
/// and tile makers stream it).
Result<void> write(ByteSink& sink, const CellsOutput& output) {
  return writeEach(sink, output.sites.size(), [&](Bytes& text, std::size_t site) {
    printFeature(text, output, site);
    text.push_back('\n');
  });
}

}  // namespace

extern const CellsFormat geojsonl_cells;
const CellsFormat geojsonl_cells{".geojsonl", Detail::polygons, /*mesh=*/false, write};

}  // namespace vorpipe
