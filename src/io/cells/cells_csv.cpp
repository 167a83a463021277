#include <string>

#include "io/cells/cell_records.h"
#include "io/cells/cell_rings.h"
#include "io/cells/cells_file.h"

namespace vorpipe {

namespace {

/// The columns that only some diagrams have, in the order of their names in headerOf().
void printMore(Bytes& text, const Diagram& diagram, std::size_t site) {
  if (!diagram.neighbor_shifts.empty()) {
    const auto shifts = diagram.cell(site).shifts();
    text.push_back(',');
    join(text, shifts.size(), " ",
         [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}:{}"), shifts[k][0], shifts[k][1]); });
  }
  if (!diagram.ring_starts.empty()) {
    print(text, FMT_COMPILE(",{}"), ringsOf(diagram, site).size());
  }
  if (!diagram.mass.empty()) {
    const Point& centroid = diagram.mass_centroid[site];
    print(text, FMT_COMPILE(",{},{},{}"), diagram.mass[site], centroid.x, centroid.y);
  }
}

std::string headerOf(const Diagram& diagram) {
  return fmt::format("site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors{}{}{}\n",
                     diagram.neighbor_shifts.empty() ? "" : ",neighbor_shifts",
                     diagram.ring_starts.empty() ? "" : ",rings",
                     diagram.mass.empty() ? "" : ",mass,mass_centroid_x,mass_centroid_y");
}

/// Columns site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors; neighbor_shifts
/// where the domain is periodic; rings where it has an outline; mass,mass_centroid_x,mass_centroid_y where it
/// has a density. The weight is 0 where sites have none; `vertices` and `rings` are numbers; neighbors are
/// separated by spaces, and so are shifts, each kx:ky.
Result<void> write(ByteSink& sink, const CellsOutput& output) {
  const Sites& sites = output.sites;
  const Diagram& diagram = output.diagram;
  auto written = sink.write(headerOf(diagram));
  if (!written) {
    return written;
  }
  return writeEach(sink, sites.size(), [&](Bytes& text, std::size_t site) {
    const auto neighbors = diagram.cell(site).neighbors();
    print(text, FMT_COMPILE("{},{},{},{},{},{},{},{},{},{},"), site, sites.x[site], sites.y[site],
          sites.weight.empty() ? 0.0 : sites.weight[site], statusWord(diagram.status[site]),
          diagram.area[site], diagram.perimeter[site], diagram.centroid[site].x, diagram.centroid[site].y,
          neighbors.size());
    join(text, neighbors.size(), " ",
         [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}"), neighbors[k]); });
    printMore(text, diagram, site);
    text.push_back('\n');
  });
}

}  // namespace

extern const CellsFormat csv_cells;
const CellsFormat csv_cells{".csv", Detail::polygons, /*mesh=*/false, write};

}  // namespace vorpipe
