#include <string>

#include "io/base/field_text.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/cell_records.h"
#include "io/cells/cell_rings.h"
#include "io/cells/cells_file.h"

namespace vorpipe {

namespace {

/// Prints the columns that only some diagrams have, in the order of headerOf().
void printMore(Bytes& text, const Diagram& diagram, std::size_t site) {
  if (!diagram.neighbor_shifts.empty()) {
    text.push_back(',');
    printShifts(text, diagram, site);
  }
  if (!diagram.ring_starts.empty()) {
    print(text, FMT_COMPILE(",{}"), ringsOf(diagram, site).size());
  }
  if (!diagram.mass.empty()) {
    const Point& centroid = diagram.mass_centroid[site];
    print(text, FMT_COMPILE(",{},{},{}"), diagram.mass[site], centroid.x, centroid.y);
  }
}

Bytes headerOf(const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  Bytes text;
  print(text,
        FMT_COMPILE("site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors{}{}{}"),
        diagram.neighbor_shifts.empty() ? "" : ",neighbor_shifts",
        diagram.ring_starts.empty() ? "" : ",rings",
        diagram.mass.empty() ? "" : ",mass,mass_centroid_x,mass_centroid_y");
  for (const std::string& name : attributeNames(output.attributes)) {
    text.push_back(',');
    printCsvField(text, name);
  }
  text.push_back('\n');
  return text;
}

void printRecord(Bytes& text, const CellsOutput& output, std::size_t site) {
  const Sites& sites = output.sites;
  const Diagram& diagram = output.diagram;
  print(text, FMT_COMPILE("{},{},{},{},{},{},{},{},{},{},"), site, sites.x[site], sites.y[site],
        sites.weight.empty() ? 0.0 : sites.weight[site], statusWord(diagram.status[site]), diagram.area[site],
        diagram.perimeter[site], diagram.centroid[site].x, diagram.centroid[site].y,
        diagram.cell(site).edges());
  printNeighbors(text, diagram, site);
  printMore(text, diagram, site);
  for (const Attribute& attribute : output.attributes) {
    text.push_back(',');
    printCsvValue(text, attribute, site);
  }
  text.push_back('\n');
}

/// Columns site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors; neighbor_shifts if
/// the domain is periodic; rings if it has an outline; mass,mass_centroid_x,mass_centroid_y if it has a
/// density; then the attributes. The weight is 0 if sites have none; `vertices` and `rings` are counts;
/// spaces separate neighbors, and shifts, each kx:ky.
Result<void> writeCsvCells(ByteSink& sink, const CellsOutput& output) {
  const Bytes header = headerOf(output);
  return sink.write({header.data(), header.size()}).and_then([&] {
    const auto put = [&](Bytes& text, std::size_t site) { printRecord(text, output, site); };
    return writeEach(sink, output.sites.size(), put, output.threads);
  });
}

}  // namespace

extern const CellsFormat csv_cells;
const CellsFormat csv_cells{
    .extension = ".csv", .detail = Detail::polygons, .write = writeCsvCells, .attributes = true};

}  // namespace vorpipe
