#include "io/cell_records.h"
#include "io/cells_writer.h"

namespace vorpipe {
namespace {

void printPoint(Bytes& text, const Point& point) { print(text, FMT_COMPILE("[{},{}]"), point.x, point.y); }

void printProperties(Bytes& text, const Sites& sites, const Diagram& diagram, std::size_t site) {
  print(text, FMT_COMPILE(R"("properties":{{"x":{},"y":{},)"), sites.x[site], sites.y[site]);
  if (!sites.weight.empty()) {
    print(text, FMT_COMPILE(R"("weight":{},)"), sites.weight[site]);
  }
  print(text, FMT_COMPILE(R"("status":"{}","owner":{},"area":{},"perimeter":{},"centroid":)"),
        statusWord(diagram.status[site]), diagram.owner[site], diagram.area[site], diagram.perimeter[site]);
  printPoint(text, diagram.centroid[site]);
  print(text, FMT_COMPILE(R"(,"neighbors":[)"));
  const auto neighbors = neighborsOf(diagram, site);
  join(text, neighbors.size(), ",",
       [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}"), neighbors[k]); });
  print(text, FMT_COMPILE("]}}"));
}

void printGeometry(Bytes& text, const Diagram& diagram, std::size_t site) {
  if (!hasPolygon(diagram, site)) {
    print(text, FMT_COMPILE(R"("geometry":null)"));
    return;
  }
  const auto ring = verticesOf(diagram, site);
  print(text, FMT_COMPILE(R"("geometry":{{"type":"Polygon","coordinates":[[)"));
  join(text, ring.size() + 1, ",",
       [&](Bytes& out, std::size_t k) { printPoint(out, ring[k % ring.size()]); });
  print(text, FMT_COMPILE("]]}}"));
}

}  // namespace

Result<void> writeGeoJsonCells(OutputFile& file, const Sites& sites, const Diagram& diagram) {
  if (auto written = file.write(R"({"type":"FeatureCollection","features":[)"); !written) {
    return written;
  }
  auto features = writeEach(file, sites.size(), [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE(R"({}{{"type":"Feature","id":{},)"), site == 0 ? "\n" : ",\n", site);
    printProperties(text, sites, diagram, site);
    text.push_back(',');
    printGeometry(text, diagram, site);
    text.push_back('}');
  });
  if (!features) {
    return features;
  }
  return file.write("\n]}\n");
}

}  // namespace vorpipe
