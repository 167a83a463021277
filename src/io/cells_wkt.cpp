#include "io/cell_records.h"
#include "io/cells_writer.h"

namespace vorpipe {

Result<void> writeWktCells(OutputFile& file, const Diagram& diagram) {
  if (diagram.status.empty()) {
    return file.write("GEOMETRYCOLLECTION EMPTY\n");
  }
  if (auto written = file.write("GEOMETRYCOLLECTION ("); !written) {
    return written;
  }
  auto polygons = writeEach(file, diagram.status.size(), [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE("{}"), site == 0 ? "\n" : ",\n");
    if (!hasPolygon(diagram, site)) {
      print(text, FMT_COMPILE("POLYGON EMPTY"));
      return;
    }
    const auto ring = verticesOf(diagram, site);
    print(text, FMT_COMPILE("POLYGON (("));
    join(text, ring.size() + 1, ", ", [&](Bytes& out, std::size_t k) {
      const Point& vertex = ring[k % ring.size()];
      print(out, FMT_COMPILE("{} {}"), vertex.x, vertex.y);
    });
    print(text, FMT_COMPILE("))"));
  });
  if (!polygons) {
    return polygons;
  }
  return file.write("\n)\n");
}

}  // namespace vorpipe
