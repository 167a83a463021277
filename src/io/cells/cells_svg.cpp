#include <algorithm>
#include <cmath>

#include "base/try.h"
#include "io/base/print.h"
#include "io/cells/cell_polygons.h"
#include "io/cells/cells_writers.h"

namespace vorpipe {
namespace {

constexpr double longer_side = 1000;

/// Maps the diagram's coordinates to pixels, y downward.
struct PixelMap {
  double xmin, ymax, scale, width, height;  ///< width and height are in pixels
};

/// Uses the box of all vertices. It is the domain if cells tile it; cells of a periodic domain extend beyond
/// it and are shown whole. The globe is a map of degrees.
PixelMap pixelMap(const CellsOutput& output) {
  const auto& vertices = output.diagram.vertices;
  const bool on_globe = output.system.on_globe;
  if (vertices.empty() && !on_globe) return {0, 0, 1, longer_side, longer_side};
  const Box box = on_globe ? Box{-180, -90, 180, 90} : boxOf(vertices);
  const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
  const double scale = longer_side / std::max(width, height);
  return {box.xmin, box.ymax, scale, width * scale, height * scale};
}

/// Returns a width that is thin compared with a polygon of mean size.
double strokeWidth(const PixelMap& map, const Diagram& diagram) {
  std::size_t polygons = 0;
  for (std::size_t site = 0; site < diagram.status.size(); ++site) {
    if (hasPolygon(diagram, site)) ++polygons;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(polygons, 1));
  return std::min(1.0, std::sqrt(map.width * map.height / count) / 20);
}

/// Returns a light color as 0xRRGGBB. Golden steps around the hues give distinct colors to nearby indices.
std::uint32_t fillColor(std::size_t site) {
  constexpr std::uint32_t golden_step = 0x9E3779B9, low = 0x78, high = 0xF0;
  const std::uint32_t turn = static_cast<std::uint32_t>(site) * golden_step;
  const std::uint64_t hue = std::uint64_t{turn} * 6;
  const auto fraction = static_cast<std::uint32_t>(hue >> 24 & 0xFF);
  const std::uint32_t rising = low + (high - low) * fraction / 0xFF, falling = high + low - rising;
  switch (hue >> 32) {
    case 0:
      return high << 16 | rising << 8 | low;
    case 1:
      return falling << 16 | high << 8 | low;
    case 2:
      return low << 16 | high << 8 | rising;
    case 3:
      return low << 16 | falling << 8 | high;
    case 4:
      return rising << 16 | low << 8 | high;
    default:
      return high << 16 | low << 8 | falling;
  }
}

void printVertices(Bytes& text, const PixelMap& map, std::span<const Point> vertices) {
  join(text, vertices.size(), " ", [&](Bytes& out, std::size_t k) {
    print(out, FMT_COMPILE("{:.8g},{:.8g}"), (vertices[k].x - map.xmin) * map.scale,
          (map.ymax - vertices[k].y) * map.scale);
  });
}

void printCell(Bytes& text, const PixelMap& map, const CellsOutput& output, std::size_t site) {
  const Diagram& diagram = output.diagram;
  const CellPolygons cell(output.sites, diagram, site, output.system);
  if (cell.empty()) return;
  const bool is_simple = cell.size() == 1 && cell[0].size() == 1;
  const std::string_view shape = is_simple ? "polygon" : "path";
  print(text, FMT_COMPILE("<{} fill=\"#{:06x}\" {}=\""), shape, fillColor(site), is_simple ? "points" : "d");
  if (is_simple) {
    printVertices(text, map, cell[0].front());
  } else {
    for (std::size_t p = 0; p < cell.size(); ++p) {
      for (const auto ring : cell[p]) {
        text.push_back('M');
        printVertices(text, map, ring);
        text.push_back('Z');
      }
    }
  }
  print(text, FMT_COMPILE("\"><title>site {}, area {}</title></{}>\n"), site, diagram.area[site], shape);
}

}  // namespace

Result<void> writeSvgCells(ByteSink& sink, const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  const PixelMap map = pixelMap(output);
  const std::string head = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.8g}\" height=\"{1:.8g}\" "
      "viewBox=\"0 0 {0:.8g} {1:.8g}\">\n"
      "<style>polygon,path{{stroke:#333;stroke-width:{2:.4g};stroke-linejoin:round;fill-rule:evenodd}}"
      "polygon:hover,path:hover{{fill-opacity:.5}}</style>\n",
      map.width, map.height, strokeWidth(map, diagram));
  VORPIPE_TRY(sink.write(head));
  const auto put = [&](Bytes& text, std::size_t site) { printCell(text, map, output, site); };
  VORPIPE_TRY(writeEach(sink, diagram.status.size(), put, output.threads));
  return sink.write("</svg>\n");
}

}  // namespace vorpipe
