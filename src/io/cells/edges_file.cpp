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
#include "io/cells/cell_attributes.h"
#include "io/cells/vtk_xml.h"

namespace vorpipe {
namespace {

/// Returns the index in Diagram::vertices of the end of a cell's edge.
std::uint64_t endEntry(const Cell& cell, std::uint64_t entry) {
  const CellRings rings = cell.rings();
  std::size_t r = 0;
  while (entry >= rings.end(r)) ++r;
  return entry + 1 < rings.end(r) ? entry + 1 : rings.begin(r);
}

/// Puts the end of a line in degrees from a plane into the turn of its beginning: around a pole an edge leads
/// from the last longitude to the first.
EdgeLine unturned(EdgeLine line, const CoordinateSystem& system) {
  constexpr double turn = 360;
  if (system.from_plane_around) line.end.x += turn * std::round((line.begin.x - line.end.x) / turn);
  return line;
}

/// Appends a site or a wall as a CSV field.
void printCsvSite(Bytes& text, const Attribute* names, std::int64_t site) {
  if (names == nullptr) {
    print(text, FMT_COMPILE("{}"), site);
  } else {
    printCsvField(text, nameOfSite(*names, site));
  }
}

/// Columns edge,site_a,site_b,length,x1,y1,x2,y2.
Result<void> writeCsvEdges(ByteSink& sink, const LinesOutput& output) {
  VORPIPE_TRY(sink.write("edge,site_a,site_b,length,x1,y1,x2,y2\n"));
  const auto put = [&](Bytes& text, std::size_t edge) {
    const EdgeLine line = output.line(edge);
    print(text, FMT_COMPILE("{},"), edge);
    printCsvSite(text, output.names, line.site_a);
    text.push_back(',');
    printCsvSite(text, output.names, line.site_b);
    print(text, FMT_COMPILE(",{},{},{},{},{}\n"), line.length, line.begin.x, line.begin.y, line.end.x,
          line.end.y);
  };
  return writeEach(sink, output.count, put, output.threads);
}

/// The parts of a line: more than one on the globe, where 180 degrees cuts it.
std::vector<std::vector<Point>> partsOf(const LinesOutput& output, std::size_t edge, const EdgeLine& line) {
  if (output.path) return cutAtTurns(output.path(edge));
  return {{line.begin, line.end}};
}

/// Appends the only part of a line, or the list of several; `put(bytes, point)` appends a point.
template <class Put>
void printParts(Bytes& text, const ListText& list, const std::vector<std::vector<Point>>& parts,
                const Put& put) {
  const auto printPart = [&](Bytes& out, const std::vector<Point>& part) {
    printList(out, list, part.size(), [&](Bytes& point, std::size_t k) { put(point, part[k]); });
  };
  if (parts.size() == 1) return printPart(text, parts.front());
  printList(text, list, parts.size(), [&](Bytes& out, std::size_t p) { printPart(out, parts[p]); });
}

/// A feature for each edge: its id is the edge, its properties are edge, site_a, site_b and length,
/// its geometry is a LineString, on the globe a MultiLineString where 180 degrees cuts it.
Result<void> writeEdgeFeatures(ByteSink& sink, FeaturesAs as, const LinesOutput& output) {
  const auto put = [&](Bytes& text, std::size_t edge) {
    const EdgeLine line = output.line(edge);
    print(text, FMT_COMPILE(R"({{"type":"Feature","id":{0},"properties":{{"edge":{0},"site_a":)"), edge);
    printJsonSite(text, output.names, line.site_a);
    text.append(std::string_view(R"(,"site_b":)"));
    printJsonSite(text, output.names, line.site_b);
    if (!output.path) {
      print(text,
            FMT_COMPILE(
                R"(,"length":{}}},"geometry":{{"type":"LineString","coordinates":[[{},{}],[{},{}]]}}}})"),
            line.length, line.begin.x, line.begin.y, line.end.x, line.end.y);
      return true;
    }
    const auto parts = partsOf(output, edge, line);
    print(text, FMT_COMPILE(R"(,"length":{}}},"geometry":{{"type":"{}","coordinates":)"), line.length,
          parts.size() > 1 ? "MultiLineString" : "LineString");
    printParts(text, json_list, parts, printJsonPoint);
    text.append(std::string_view("}}"));
    return true;
  };
  return writeFeatures(sink, as, output.system, output.count, put, output.threads);
}

Result<void> writeGeojsonEdges(ByteSink& sink, const LinesOutput& output) {
  return writeEdgeFeatures(sink, FeaturesAs::collection, output);
}

Result<void> writeGeojsonlEdges(ByteSink& sink, const LinesOutput& output) {
  return writeEdgeFeatures(sink, FeaturesAs::lines, output);
}

/// A GeoPackage with a layer of LineStrings, on the globe of MultiLineStrings.
Result<void> writeGpkgEdges(ByteSink& sink, const LinesOutput& output) {
  // Walls have names that are text, whatever those of sites are.
  const AttributeType site = output.names == nullptr ? AttributeType::integer : AttributeType::text;
  const Layer layer{
      std::string(output.layer),
      output.path ? GeometryType::multi_line_string : GeometryType::line_string,
      {{"edge", AttributeType::integer}, {"site_a", site}, {"site_b", site}, {"length", AttributeType::real}},
      output.system};
  Wkb wkb;
  return writeGeoPackage(sink, layer, output.count, [&](std::size_t edge, FeatureRow& row) {
    const EdgeLine line = output.line(edge);
    wkb.clear();
    const auto parts = partsOf(output, edge, line);
    if (output.path) wkb.begin(GeometryType::multi_line_string, parts.size());
    for (const auto& part : parts) {
      wkb.begin(GeometryType::line_string, part.size());
      for (const Point point : part) wkb.add(point);
    }
    row.setGeometry(wkb);
    row.add(static_cast<std::int64_t>(edge));
    for (const std::int64_t of : {line.site_a, line.site_b}) {
      if (output.names == nullptr) {
        row.add(of);
      } else {
        row.add(nameOfSite(*output.names, of));
      }
    }
    row.add(line.length);
    return true;
  });
}

/// A line for each edge, from its beginning to its end.
Result<void> writeWktEdges(ByteSink& sink, const LinesOutput& output) {
  const std::size_t count = output.count;
  if (count == 0) return sink.write("GEOMETRYCOLLECTION EMPTY\n");
  VORPIPE_TRY(sink.write("GEOMETRYCOLLECTION ("));
  const auto put = [&](Bytes& text, std::size_t edge) {
    const EdgeLine line = output.line(edge);
    const auto parts = partsOf(output, edge, line);
    print(text, FMT_COMPILE("{}\n{} "), edge == 0 ? "" : ",",
          parts.size() > 1 ? "MULTILINESTRING" : "LINESTRING");
    printParts(text, {"(", ", ", ")"}, parts,
               [](Bytes& out, const Point& point) { print(out, FMT_COMPILE("{} {}"), point.x, point.y); });
  };
  VORPIPE_TRY(writeEach(sink, count, put, output.threads));
  return sink.write("\n)\n");
}

/// The data of lines.
VtkSection lineData(const LinesOutput& output) {
  const std::size_t count = output.count;
  const auto sites = [&](std::string_view name, std::int64_t EdgeLine::*side) {
    return vtkNumbers<std::int64_t>(name, count,
                                    [&output, side](std::size_t edge) { return output.line(edge).*side; });
  };
  return {"CellData",
          {vtkNumbers<std::int64_t>("edge", count, [](std::size_t edge) { return edge; }),
           sites("site_a", &EdgeLine::site_a), sites("site_b", &EdgeLine::site_b),
           vtkNumbers<double>("length", count,
                              [&output](std::size_t edge) { return output.line(edge).length; })}};
}

/// Lines on the unit sphere, each with points of its own.
Result<void> writeVtpGlobe(ByteSink& sink, const LinesOutput& output) {
  std::vector<Point> points;
  std::vector<std::uint64_t> offsets;
  for (std::size_t edge = 0; edge < output.count; ++edge) {
    const auto path = output.path(edge);
    points.insert(points.end(), path.begin(), path.end());
    offsets.push_back(points.size());
  }
  return writeVtkXml(
      sink,
      {"PolyData",
       polyDataCounts(points.size(), output.count, 0),
       {{"Points", {vtkPoints("Points", points.size(), [&](std::size_t k) { return onGlobe(points[k]); })}},
        {"Lines",
         {vtkNumbers<std::int64_t>("connectivity", points.size(), [](std::size_t k) { return k; }),
          vtkNumbers<std::int64_t>("offsets", output.count,
                                   [&](std::size_t edge) { return offsets[edge]; })}},
        lineData(output)}});
}

/// PolyData with lines, z is 0 but on the globe.
Result<void> writeVtpEdges(ByteSink& sink, const LinesOutput& output) {
  if (output.path) return writeVtpGlobe(sink, output);
  const std::size_t count = output.count;
  const bool apart = !output.ends;
  const std::size_t points = apart ? 2 * count : output.points.size();
  const auto ends = [&, apart](std::size_t k) -> std::size_t {
    return apart ? k : output.ends(k / 2)[k % 2];
  };
  const auto position = [&, apart](std::size_t point) {
    if (!apart) return output.points[point];
    const EdgeLine line = output.line(point / 2);
    return point % 2 == 0 ? line.begin : line.end;
  };
  return writeVtkXml(
      sink, {"PolyData",
             polyDataCounts(points, count, 0),
             {{"Points", {vtkPoints("Points", points, position)}},
              {"Lines",
               {vtkNumbers<std::int64_t>("connectivity", 2 * count, ends),
                vtkNumbers<std::int64_t>("offsets", count, [](std::size_t edge) { return 2 * edge + 2; })}},
              lineData(output)}});
}

constexpr EdgesFormat csv_edges{.extension = ".csv", .write = writeCsvEdges, .names = true},
    geojson_edges{.extension = ".geojson", .write = writeGeojsonEdges, .names = true},
    geojsonl_edges{.extension = ".geojsonl", .write = writeGeojsonlEdges, .names = true},
    gpkg_edges{.extension = ".gpkg", .write = writeGpkgEdges, .in_memory = true, .names = true},
    wkt_edges{.extension = ".wkt", .write = writeWktEdges},
    vtp_edges{.extension = ".vtp", .write = writeVtpEdges};
constexpr std::array edges_formats{&csv_edges,  &geojson_edges, &geojsonl_edges,
                                   &gpkg_edges, &wkt_edges,     &vtp_edges};
constexpr std::span<const EdgesFormat* const> all_edges_formats(edges_formats);

}  // namespace

std::vector<std::string_view> edgesExtensions() { return extensionsOf(all_edges_formats); }

Result<const EdgesFormat*> edgesFormatOf(const std::string& path) {
  return formatFor(path, "edges", all_edges_formats);
}

LinesOutput edgesOf(const Sites& sites, const Diagram& diagram, const Topology& topology,
                    const CoordinateSystem& system) {
  assert(topology.edge_of.size() == diagram.vertices.size());
  // In a periodic domain the cells of an edge may have it at two places; the line is at that of `site_a`.
  const auto line = [&diagram, &topology, system](std::size_t edge) {
    const std::uint64_t entry = topology.edge_entry[edge];
    const auto [site_a, site_b] = topology.edge_cells[edge];
    const Cell cell = diagram.cell(static_cast<std::size_t>(site_a));
    return unturned({diagram.vertices[entry], diagram.vertices[endEntry(cell, entry)], site_a, site_b,
                     diagram.edge_lengths[entry]},
                    system);
  };
  LinesOutput output{"edges", topology.edge_entry.size(), line, system};
  // A vertex has several positions in a periodic domain, and in several turns of degrees from a projection.
  if (diagram.neighbor_shifts.empty() && !system.from_plane_around) {
    output.points = topology.vertices;
    output.ends = [&topology](std::size_t edge) { return topology.edge_vertices[edge]; };
  }
  if (system.on_globe) {
    output.path = [&](std::size_t edge) {
      const auto site = static_cast<std::size_t>(topology.edge_cells[edge][0]);
      return globeEdge(sites, diagram, site, topology.edge_entry[edge]);
    };
  }
  return output;
}

TriangulationLines triangulationLines(const Sites& sites, const Diagram& diagram) {
  TriangulationLines lines{triangulationEdges(sites, diagram), {}};
  lines.lengths.reserve(lines.sites.size());
  const bool on_globe = !diagram.solid_angle.empty();
  for (const auto& [a, b] : lines.sites) {
    const Point from{sites.x[a], sites.y[a]}, to{sites.x[b], sites.y[b]};
    lines.lengths.push_back(on_globe ? globeDistance(from, to) : std::hypot(to.x - from.x, to.y - from.y));
  }
  return lines;
}

LinesOutput linesOf(const TriangulationLines& lines, const Sites& shown, const CoordinateSystem& system) {
  const auto line = [&lines, &shown, system](std::size_t edge) {
    const auto [a, b] = lines.sites[edge];
    return unturned({{shown.x[a], shown.y[a]}, {shown.x[b], shown.y[b]}, a, b, lines.lengths[edge]}, system);
  };
  LinesOutput output{"triangulation", lines.sites.size(), line, system};
  if (system.on_globe) {
    output.path = [&](std::size_t edge) {
      const auto [a, b] = lines.sites[edge];
      return globeWay({shown.x[a], shown.y[a]}, {shown.x[b], shown.y[b]});
    };
  }
  return output;
}

Result<void> writeLines(ByteSink& sink, const LinesOutput& output, const EdgesFormat& format) {
  try {
    return format.write(sink, output);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write the edges");
  }
}

}  // namespace vorpipe
