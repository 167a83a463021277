#include "io/cells/geojson_feature.h"

#include "io/base/field_text.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/cell_records.h"
#include "io/cells/cell_rings.h"
#include "io/cells/polygon_text.h"

namespace vorpipe {
namespace {

void printProperties(Bytes& text, const Sites& sites, const Diagram& diagram, std::size_t site) {
  print(text, FMT_COMPILE(R"("properties":{{"x":{},"y":{},)"), sites.x[site], sites.y[site]);
  if (!sites.weight.empty()) {
    print(text, FMT_COMPILE(R"("weight":{},)"), sites.weight[site]);
  }
  print(text, FMT_COMPILE(R"("status":"{}","owner":{},"area":{},"perimeter":{},"centroid":)"),
        statusWord(diagram.status[site]), diagram.owner[site], diagram.area[site], diagram.perimeter[site]);
  printJsonPoint(text, diagram.centroid[site]);
  if (!diagram.mass.empty()) {
    print(text, FMT_COMPILE(R"(,"mass":{},"mass_centroid":)"), diagram.mass[site]);
    printJsonPoint(text, diagram.mass_centroid[site]);
  }
  text.append(std::string_view(R"(,"neighbors":)"));
  const auto neighbors = diagram.cell(site).neighbors();
  printList(text, json_list, neighbors.size(),
            [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}"), neighbors[k]); });
  if (!diagram.neighbor_shifts.empty()) {
    text.append(std::string_view(R"(,"neighbor_shifts":)"));
    const auto shifts = diagram.cell(site).shifts();
    printList(text, json_list, shifts.size(), [&](Bytes& out, std::size_t k) {
      print(out, FMT_COMPILE("[{},{}]"), shifts[k][0], shifts[k][1]);
    });
  }
}

void printGeometry(Bytes& text, const CellPolygons& cell) {
  if (cell.empty()) {
    text.append(std::string_view(R"("geometry":null)"));
    return;
  }
  const bool several = cell.size() > 1;
  print(text, FMT_COMPILE(R"("geometry":{{"type":"{}","coordinates":)"),
        several ? "MultiPolygon" : "Polygon");
  if (several) {
    printPolygons(text, json_list, cell, printJsonPoint);
  } else {
    printPolygon(text, json_list, cell[0], printJsonPoint);
  }
  text.push_back('}');
}

/// Returns the names of attributes as JSON strings, each with the comma before it and the colon after it.
std::vector<std::string> keysOf(const CellsOutput& output) {
  std::vector<std::string> keys;
  for (const std::string& name : attributeNames(output.attributes)) {
    Bytes key;
    key.push_back(',');
    printJsonString(key, name);
    key.push_back(':');
    keys.push_back(fmt::to_string(key));
  }
  return keys;
}

void printFeature(Bytes& text, const CellsOutput& output, const std::vector<std::string>& keys,
                  std::size_t site) {
  print(text, FMT_COMPILE(R"({{"type":"Feature","id":{},)"), site);
  printProperties(text, output.sites, output.diagram, site);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    text.append(keys[k]);
    printJsonValue(text, output.attributes[k], site);
  }
  text.append(std::string_view("},"));
  printGeometry(text, {output.diagram, site, output.system});
  text.push_back('}');
}

}  // namespace

Result<void> writeCellFeatures(ByteSink& sink, FeaturesAs as, const CellsOutput& output) {
  const auto keys = keysOf(output);
  const auto put = [&](Bytes& text, std::size_t site) {
    if (output.only_cells && !hasPolygon(output.diagram, site)) return false;
    printFeature(text, output, keys, site);
    return true;
  };
  return writeFeatures(sink, as, output.sites.size(), put, output.threads);
}

}  // namespace vorpipe
