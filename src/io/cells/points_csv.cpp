#include "io/base/field_text.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/points_file.h"

namespace vorpipe {
namespace {

/// Columns x,y, or lon,lat if the sites are in degrees; weight if they have one; then the attributes.
Result<void> writeCsvPoints(ByteSink& sink, const PointsOutput& output) {
  const Sites& sites = output.sites;
  const bool weighted = !sites.weight.empty();
  Bytes header;
  print(header, FMT_COMPILE("{}{}"), output.system.kind == CoordinateKind::degrees ? "lon,lat" : "x,y",
        weighted ? ",weight" : "");
  for (const std::string& name : pointAttributeNames(output.attributes)) {
    header.push_back(',');
    printCsvField(header, name);
  }
  header.push_back('\n');
  return writeAll(sink, header).and_then([&] {
    const auto put = [&](Bytes& text, std::size_t site) {
      print(text, FMT_COMPILE("{},{}"), sites.x[site], sites.y[site]);
      if (weighted) print(text, FMT_COMPILE(",{}"), sites.weight[site]);
      for (const Attribute& attribute : output.attributes) {
        text.push_back(',');
        printCsvValue(text, attribute, site);
      }
      text.push_back('\n');
    };
    return writeEach(sink, sites.size(), put, output.threads);
  });
}

}  // namespace

extern const PointsFormat csv_points;
const PointsFormat csv_points{.extension = ".csv", .write = writeCsvPoints, .attributes = true};

}  // namespace vorpipe
