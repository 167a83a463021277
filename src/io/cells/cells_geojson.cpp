#include "io/cells/cells_file.h"
#include "io/cells/geojson_feature.h"

namespace vorpipe {
namespace {

/// A FeatureCollection, with a feature for each site.
Result<void> write(ByteSink& sink, const CellsOutput& output) {
  if (auto written = sink.write(R"({"type":"FeatureCollection","features":[)"); !written) {
    return written;
  }
  auto features = writeEach(sink, output.sites.size(), [&](Bytes& text, std::size_t site) {
    text.append(std::string_view(site == 0 ? "\n" : ",\n"));
    printFeature(text, output, site);
  });
  if (!features) {
    return features;
  }
  return sink.write("\n]}\n");
}

}  // namespace

extern const CellsFormat geojson_cells;
const CellsFormat geojson_cells{".geojson", Detail::polygons, /*mesh=*/false, write};

}  // namespace vorpipe
