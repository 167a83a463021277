#include "io/cells/geojson_feature.h"

#include "io/cells/polygon_text.h"

namespace vorpipe {
namespace {

void printPoint(Bytes& text, const Point& point) { print(text, FMT_COMPILE("[{},{}]"), point.x, point.y); }

constexpr ListText json_list{"[", ",", "]"};

void printProperties(Bytes& text, const Sites& sites, const Diagram& diagram, std::size_t site) {
  print(text, FMT_COMPILE(R"("properties":{{"x":{},"y":{},)"), sites.x[site], sites.y[site]);
  if (!sites.weight.empty()) {
    print(text, FMT_COMPILE(R"("weight":{},)"), sites.weight[site]);
  }
  print(text, FMT_COMPILE(R"("status":"{}","owner":{},"area":{},"perimeter":{},"centroid":)"),
        statusWord(diagram.status[site]), diagram.owner[site], diagram.area[site], diagram.perimeter[site]);
  printPoint(text, diagram.centroid[site]);
  if (!diagram.mass.empty()) {
    print(text, FMT_COMPILE(R"(,"mass":{},"mass_centroid":)"), diagram.mass[site]);
    printPoint(text, diagram.mass_centroid[site]);
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
  text.push_back('}');
}

void printGeometry(Bytes& text, const Diagram& diagram, std::size_t site) {
  const auto rings = ringsOf(diagram, site);
  const auto pieces = piecesOf(rings);
  if (pieces.empty()) {
    text.append(std::string_view(R"("geometry":null)"));
    return;
  }
  const bool several = pieces.size() > 1;
  print(text, FMT_COMPILE(R"("geometry":{{"type":"{}","coordinates":)"),
        several ? "MultiPolygon" : "Polygon");
  if (several) {
    printPolygons(text, json_list, diagram, pieces, printPoint);
  } else {
    printPolygon(text, json_list, diagram, pieces.front(), printPoint);
  }
  text.push_back('}');
}

}  // namespace

void printFeature(Bytes& text, const CellsOutput& output, std::size_t site) {
  print(text, FMT_COMPILE(R"({{"type":"Feature","id":{},)"), site);
  printProperties(text, output.sites, output.diagram, site);
  text.push_back(',');
  printGeometry(text, output.diagram, site);
  text.push_back('}');
}

}  // namespace vorpipe
