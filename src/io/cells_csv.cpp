#include "io/cell_records.h"
#include "io/cells_writer.h"

namespace vorpipe {

Result<void> writeCsvCells(OutputFile& file, const Sites& sites, const Diagram& diagram) {
  auto written =
      file.write("site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors\n");
  if (!written) {
    return written;
  }
  return writeEach(file, sites.size(), [&](Bytes& text, std::size_t site) {
    const auto neighbors = neighborsOf(diagram, site);
    print(text, FMT_COMPILE("{},{},{},{},{},{},{},{},{},{},"), site, sites.x[site], sites.y[site],
          sites.weight.empty() ? 0.0 : sites.weight[site], statusWord(diagram.status[site]),
          diagram.area[site], diagram.perimeter[site], diagram.centroid[site].x, diagram.centroid[site].y,
          neighbors.size());
    join(text, neighbors.size(), " ",
         [&](Bytes& out, std::size_t k) { print(out, FMT_COMPILE("{}"), neighbors[k]); });
    text.push_back('\n');
  });
}

}  // namespace vorpipe
