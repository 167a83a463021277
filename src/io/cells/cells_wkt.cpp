#include "base/try.h"
#include "io/base/print.h"
#include "io/cells/cells_file.h"
#include "io/cells/polygon_text.h"

namespace vorpipe {
namespace {

constexpr ListText wkt_list{"(", ", ", ")"};

void printPoint(Bytes& text, const Point& point) { print(text, FMT_COMPILE("{} {}"), point.x, point.y); }

void printCell(Bytes& text, const CellPolygons& cell) {
  if (cell.empty()) {
    text.append(std::string_view("POLYGON EMPTY"));
  } else if (cell.size() == 1) {
    text.append(std::string_view("POLYGON "));
    printPolygon(text, wkt_list, cell[0], printPoint);
  } else {
    text.append(std::string_view("MULTIPOLYGON "));
    printPolygons(text, wkt_list, cell, printPoint);
  }
}

/// Polygons begin and end at the same vertex.
Result<void> writeWktCells(ByteSink& sink, const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  if (diagram.status.empty()) {
    return sink.write("GEOMETRYCOLLECTION EMPTY\n");
  }
  VORPIPE_TRY(sink.write("GEOMETRYCOLLECTION ("));
  const auto put = [&](Bytes& text, std::size_t site) {
    text.append(std::string_view(site == 0 ? "\n" : ",\n"));
    printCell(text, {diagram, site, output.system});
  };
  auto polygons = writeEach(sink, diagram.status.size(), put, output.threads);
  if (!polygons) {
    return polygons;
  }
  return sink.write("\n)\n");
}

}  // namespace

extern const CellsFormat wkt_cells;
const CellsFormat wkt_cells{.extension = ".wkt", .detail = Detail::polygons, .write = writeWktCells};

}  // namespace vorpipe
