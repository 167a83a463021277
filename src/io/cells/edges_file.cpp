#include "io/cells/edges_file.h"

#include <array>
#include <cassert>
#include <cmath>
#include <new>
#include <span>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/field_text.h"
#include "io/base/geopackage.h"
#include "io/base/print.h"
#include "io/cells/vtk_xml.h"

namespace vorpipe {
namespace {

/// An edge as seen from its first cell.
struct EdgeLine {
  Point begin, end;
  std::int64_t site_a;  ///< on its left
  std::int64_t site_b;  ///< on its right: a site, or a wall (isWall())
  double length;
};

/// Returns the index in Diagram::vertices of the end of a cell's edge.
std::uint64_t endEntry(const Cell& cell, std::uint64_t entry) {
  const CellRings rings = cell.rings();
  std::size_t r = 0;
  while (entry >= rings.end(r)) ++r;
  return entry + 1 < rings.end(r) ? entry + 1 : rings.begin(r);
}

/// Edge `edge` of the topology. In a periodic domain its position is that in the cell of `site_a`.
EdgeLine edgeLine(const EdgesOutput& output, std::size_t edge) {
  const Diagram& diagram = output.diagram;
  const std::uint64_t entry = output.topology.edge_entry[edge];
  const auto [site_a, site_b] = output.topology.edge_cells[edge];
  const Cell cell = diagram.cell(static_cast<std::size_t>(site_a));
  EdgeLine line{diagram.vertices[entry], diagram.vertices[endEntry(cell, entry)], site_a, site_b,
                diagram.edge_lengths[entry]};
  if (output.system.from_plane_around) {
    // Around a pole one edge leads from the last longitude to the first.
    constexpr double turn = 360;
    line.end.x += turn * std::round((line.begin.x - line.end.x) / turn);
  }
  return line;
}

/// Columns edge,site_a,site_b,length,x1,y1,x2,y2.
Result<void> writeCsvEdges(ByteSink& sink, const EdgesOutput& output) {
  VORPIPE_TRY(sink.write("edge,site_a,site_b,length,x1,y1,x2,y2\n"));
  const auto put = [&](Bytes& text, std::size_t edge) {
    const EdgeLine line = edgeLine(output, edge);
    print(text, FMT_COMPILE("{},{},{},{},{},{},{},{}\n"), edge, line.site_a, line.site_b, line.length,
          line.begin.x, line.begin.y, line.end.x, line.end.y);
  };
  return writeEach(sink, output.topology.edge_entry.size(), put, output.threads);
}

/// A feature for each edge: its id is the edge, its properties are edge, site_a, site_b and length,
/// its geometry is a LineString.
Result<void> writeEdgeFeatures(ByteSink& sink, FeaturesAs as, const EdgesOutput& output) {
  const auto put = [&](Bytes& text, std::size_t edge) {
    const EdgeLine line = edgeLine(output, edge);
    print(text,
          FMT_COMPILE(
              R"({{"type":"Feature","id":{0},"properties":{{"edge":{0},"site_a":{1},"site_b":{2},)"
              R"("length":{3}}},"geometry":{{"type":"LineString","coordinates":[[{4},{5}],[{6},{7}]]}}}})"),
          edge, line.site_a, line.site_b, line.length, line.begin.x, line.begin.y, line.end.x, line.end.y);
    return true;
  };
  return writeFeatures(sink, as, output.topology.edge_entry.size(), put, output.threads);
}

Result<void> writeGeojsonEdges(ByteSink& sink, const EdgesOutput& output) {
  return writeEdgeFeatures(sink, FeaturesAs::collection, output);
}

Result<void> writeGeojsonlEdges(ByteSink& sink, const EdgesOutput& output) {
  return writeEdgeFeatures(sink, FeaturesAs::lines, output);
}

/// A GeoPackage with the layer `edges`, of LineStrings.
Result<void> writeGpkgEdges(ByteSink& sink, const EdgesOutput& output) {
  const Layer layer{"edges",
                    GeometryType::line_string,
                    {{"edge", AttributeType::integer},
                     {"site_a", AttributeType::integer},
                     {"site_b", AttributeType::integer},
                     {"length", AttributeType::real}},
                    output.system};
  Wkb wkb;
  return writeGeoPackage(sink, layer, output.topology.edge_entry.size(),
                         [&](std::size_t edge, FeatureRow& row) {
                           const EdgeLine line = edgeLine(output, edge);
                           wkb.clear();
                           wkb.begin(GeometryType::line_string, 2);
                           wkb.add(line.begin);
                           wkb.add(line.end);
                           row.setGeometry(wkb);
                           row.add(static_cast<std::int64_t>(edge));
                           row.add(line.site_a);
                           row.add(line.site_b);
                           row.add(line.length);
                           return true;
                         });
}

/// A line for each edge, from its beginning to its end.
Result<void> writeWktEdges(ByteSink& sink, const EdgesOutput& output) {
  const std::size_t count = output.topology.edge_entry.size();
  if (count == 0) return sink.write("GEOMETRYCOLLECTION EMPTY\n");
  VORPIPE_TRY(sink.write("GEOMETRYCOLLECTION ("));
  const auto put = [&](Bytes& text, std::size_t edge) {
    const EdgeLine line = edgeLine(output, edge);
    print(text, FMT_COMPILE("{}\nLINESTRING ({} {}, {} {})"), edge == 0 ? "" : ",", line.begin.x,
          line.begin.y, line.end.x, line.end.y);
  };
  VORPIPE_TRY(writeEach(sink, count, put, output.threads));
  return sink.write("\n)\n");
}

/// PolyData with lines, z is 0. Edges share their ends, unless a vertex has several positions: in a periodic
/// domain, or in several turns of degrees from a projection.
Result<void> writeVtpEdges(ByteSink& sink, const EdgesOutput& output) {
  const Topology& topology = output.topology;
  const std::size_t count = topology.edge_entry.size();
  const bool apart = !output.diagram.neighbor_shifts.empty() || output.system.from_plane_around;
  const std::size_t points = apart ? 2 * count : topology.vertices.size();
  const auto ends = [&, apart](std::size_t k) -> std::size_t {
    return apart ? k : topology.edge_vertices[k / 2][k % 2];
  };
  const auto position = [&, apart](std::size_t point) {
    if (!apart) return topology.vertices[point];
    const EdgeLine line = edgeLine(output, point / 2);
    return point % 2 == 0 ? line.begin : line.end;
  };
  const auto sites = [&](std::string_view name, std::size_t side) {
    return vtkNumbers<std::int64_t>(
        name, count, [&topology, side](std::size_t edge) { return topology.edge_cells[edge][side]; });
  };
  return writeVtkXml(
      sink,
      {"PolyData",
       polyDataCounts(points, count, 0),
       {{"Points", {vtkPoints("Points", points, position)}},
        {"Lines",
         {vtkNumbers<std::int64_t>("connectivity", 2 * count, ends),
          vtkNumbers<std::int64_t>("offsets", count, [](std::size_t edge) { return 2 * edge + 2; })}},
        {"CellData",
         {vtkNumbers<std::int64_t>("edge", count, [](std::size_t edge) { return edge; }), sites("site_a", 0),
          sites("site_b", 1), vtkNumbers<double>("length", count, [&](std::size_t edge) {
            return output.diagram.edge_lengths[topology.edge_entry[edge]];
          })}}}});
}

constexpr EdgesFormat csv_edges{".csv", writeCsvEdges}, geojson_edges{".geojson", writeGeojsonEdges},
    geojsonl_edges{".geojsonl", writeGeojsonlEdges}, gpkg_edges{".gpkg", writeGpkgEdges, /*in_memory=*/true},
    wkt_edges{".wkt", writeWktEdges}, vtp_edges{".vtp", writeVtpEdges};
constexpr std::array edges_formats{&csv_edges,  &geojson_edges, &geojsonl_edges,
                                   &gpkg_edges, &wkt_edges,     &vtp_edges};
constexpr std::span<const EdgesFormat* const> all_edges_formats(edges_formats);

}  // namespace

std::vector<std::string_view> edgesExtensions() { return extensionsOf(all_edges_formats); }

Result<const EdgesFormat*> edgesFormatOf(const std::string& path) {
  return formatFor(path, "edges", all_edges_formats);
}

Result<void> writeEdges(ByteSink& sink, const EdgesOutput& output, const EdgesFormat& format) {
  assert(output.topology.edge_of.size() == output.diagram.vertices.size());
  try {
    return format.write(sink, output);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write the edges");
  }
}

}  // namespace vorpipe
