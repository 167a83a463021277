// Cells as text: .csv, .geojson, .geojsonl and .wkt.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/try.h"
#include "io/base/field_text.h"
#include "io/base/print.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/cell_polygons.h"
#include "io/cells/cells_writers.h"

namespace vorpipe {
namespace {

/// Whether a site has the place, and so the cell, of another.
bool hasDuplicates(const Diagram& diagram) { return diagram.report.duplicate > 0; }

Bytes headerOf(const CellsOutput& output, std::span<const AddedField> added) {
  const Diagram& diagram = output.diagram;
  Bytes text;
  print(text,
        FMT_COMPILE("site,x,y,weight,status,area,perimeter,centroid_x,centroid_y,vertices,neighbors{}{}{}"),
        diagram.neighbor_shifts.empty() ? "" : ",neighbor_shifts",
        diagram.ring_starts.empty() ? "" : ",rings",
        diagram.mass.empty() ? "" : ",mass,mass_centroid_x,mass_centroid_y");
  if (hasDuplicates(diagram)) text.append(std::string_view(",owner"));
  for (const AddedField& field : added) print(text, FMT_COMPILE(",{}"), field.name);
  printCsvNames(text, attributeNames(output.attributes, added));
  text.push_back('\n');
  return text;
}

/// Appends a row with the columns of headerOf().
void printRecord(Bytes& text, const CellsOutput& output, std::span<const AddedField> added,
                 std::size_t site) {
  const Sites& sites = output.sites;
  const Diagram& diagram = output.diagram;
  print(text, FMT_COMPILE("{},{},{},{},{},{},{},{},{},{},"), site, sites.x[site], sites.y[site],
        sites.weight.empty() ? 0.0 : sites.weight[site], statusWord(diagram.status[site]), diagram.area[site],
        diagram.perimeter[site], diagram.centroid[site].x, diagram.centroid[site].y,
        diagram.cell(site).edges());
  if (output.names == nullptr) {
    printNeighbors(text, output, site);
  } else {
    Bytes names;
    printNeighbors(names, output, site);
    if (names.size() > 0) printCsvField(text, {names.data(), names.size()});
  }
  if (!diagram.neighbor_shifts.empty()) {
    text.push_back(',');
    printShifts(text, diagram, site);
  }
  if (!diagram.ring_starts.empty()) print(text, FMT_COMPILE(",{}"), ringsOf(diagram, site).size());
  if (!diagram.mass.empty()) {
    const Point& centroid = diagram.mass_centroid[site];
    print(text, FMT_COMPILE(",{},{},{}"), diagram.mass[site], centroid.x, centroid.y);
  }
  if (hasDuplicates(diagram)) {
    const std::uint32_t owner = diagram.owner[site];
    if (output.names == nullptr) {
      print(text, FMT_COMPILE(",{}"), owner);
    } else {
      printCsvValues(text, {output.names, 1}, owner);
    }
  }
  for (const AddedField& field : added) print(text, FMT_COMPILE(",{}"), diagram.area[site] / field.divisor);
  printCsvValues(text, output.attributes, site);
  text.push_back('\n');
}

/// Appends the rings of one polygon, each ending at its first point; `put(bytes, point)` appends a point.
template <class Put>
void printPolygon(Bytes& text, const ListText& list, const CellPolygons::Rings& polygon, const Put& put) {
  printList(text, list, polygon.size(), [&](Bytes& rings, std::size_t r) {
    const auto vertices = polygon[r];
    printList(rings, list, vertices.size() + 1,
              [&](Bytes& points, std::size_t k) { put(points, vertices[k % vertices.size()]); });
  });
}

/// Appends the only polygon of a cell, or the list of several.
template <class Put>
void printPolygons(Bytes& text, const ListText& list, const CellPolygons& cell, const Put& put) {
  if (cell.size() == 1) return printPolygon(text, list, cell[0], put);
  printList(text, list, cell.size(),
            [&](Bytes& polygons, std::size_t p) { printPolygon(polygons, list, cell[p], put); });
}

void printProperties(Bytes& text, const CellsOutput& output, std::span<const AddedField> added,
                     std::size_t site) {
  const Sites& sites = output.sites;
  const Diagram& diagram = output.diagram;
  print(text, FMT_COMPILE(R"("properties":{{"x":{},"y":{},)"), sites.x[site], sites.y[site]);
  if (!sites.weight.empty()) print(text, FMT_COMPILE(R"("weight":{},)"), sites.weight[site]);
  print(text, FMT_COMPILE(R"("status":"{}","owner":)"), statusWord(diagram.status[site]));
  printJsonSite(text, output.names, diagram.owner[site]);
  print(text, FMT_COMPILE(R"(,"area":{},"perimeter":{},"centroid":)"), diagram.area[site],
        diagram.perimeter[site]);
  printJsonPoint(text, diagram.centroid[site]);
  if (!diagram.mass.empty()) {
    print(text, FMT_COMPILE(R"(,"mass":{},"mass_centroid":)"), diagram.mass[site]);
    printJsonPoint(text, diagram.mass_centroid[site]);
  }
  text.append(std::string_view(R"(,"neighbors":)"));
  const auto printNeighborList = [&](const auto& neighbors) {
    printList(text, json_list, neighbors.size(),
              [&](Bytes& out, std::size_t k) { printJsonSite(out, output.names, neighbors[k]); });
  };
  if (output.names == nullptr) {
    printNeighborList(diagram.cell(site).neighbors());
  } else {
    printNeighborList(namedNeighbors(diagram, site));
  }
  if (!diagram.neighbor_shifts.empty()) {
    text.append(std::string_view(R"(,"neighbor_shifts":)"));
    const auto shifts = diagram.cell(site).shifts();
    printList(text, json_list, shifts.size(), [&](Bytes& out, std::size_t k) {
      print(out, FMT_COMPILE("[{},{}]"), shifts[k][0], shifts[k][1]);
    });
  }
  for (const AddedField& field : added)
    print(text, FMT_COMPILE(R"(,"{}":{})"), field.name, diagram.area[site] / field.divisor);
}

Result<void> writeCellFeatures(ByteSink& sink, FeaturesAs as, const CellsOutput& output) {
  const auto added = addedFields(output);
  const auto keys = jsonKeys(attributeNames(output.attributes, added));
  const auto put = [&](Bytes& text, std::size_t site) {
    if (output.only_cells && !hasPolygon(output.diagram, site)) return false;
    print(text, FMT_COMPILE(R"({{"type":"Feature","id":{},)"), site);
    printProperties(text, output, added, site);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      text.push_back(',');
      text.append(keys[k]);
      printJsonValue(text, output.attributes[k], site);
    }
    text.append(std::string_view("},"));
    printGeometry(text, {output.sites, output.diagram, site, output.system});
    text.push_back('}');
    return true;
  };
  return writeFeatures(sink, as, output.system, output.sites.size(), put, output.threads);
}

void printWkt(Bytes& text, const CellPolygons& cell) {
  if (cell.empty()) {
    text.append(std::string_view("POLYGON EMPTY"));
    return;
  }
  text.append(std::string_view(cell.size() == 1 ? "POLYGON " : "MULTIPOLYGON "));
  printPolygons(text, {"(", ", ", ")"}, cell,
                [](Bytes& out, const Point& point) { print(out, FMT_COMPILE("{} {}"), point.x, point.y); });
}

}  // namespace

void printGeometry(Bytes& text, const CellPolygons& cell) {
  if (cell.empty()) {
    text.append(std::string_view(R"("geometry":null)"));
    return;
  }
  print(text, FMT_COMPILE(R"("geometry":{{"type":"{}","coordinates":)"),
        cell.size() > 1 ? "MultiPolygon" : "Polygon");
  printPolygons(text, json_list, cell, printJsonPoint);
  text.push_back('}');
}

Result<void> writeCsvCells(ByteSink& sink, const CellsOutput& output) {
  const auto added = addedFields(output);
  Bytes header = headerOf(output, added);
  VORPIPE_TRY(writeAll(sink, header));
  const auto put = [&](Bytes& text, std::size_t site) { printRecord(text, output, added, site); };
  return writeEach(sink, output.sites.size(), put, output.threads);
}

Result<void> writeGeojsonCells(ByteSink& sink, const CellsOutput& output) {
  return writeCellFeatures(sink, FeaturesAs::collection, output);
}

Result<void> writeGeojsonlCells(ByteSink& sink, const CellsOutput& output) {
  return writeCellFeatures(sink, FeaturesAs::lines, output);
}

Result<void> writeWktCells(ByteSink& sink, const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  if (diagram.status.empty()) return sink.write("GEOMETRYCOLLECTION EMPTY\n");
  VORPIPE_TRY(sink.write("GEOMETRYCOLLECTION ("));
  const auto put = [&](Bytes& text, std::size_t site) {
    text.append(std::string_view(site == 0 ? "\n" : ",\n"));
    printWkt(text, {output.sites, diagram, site, output.system});
  };
  VORPIPE_TRY(writeEach(sink, diagram.status.size(), put, output.threads));
  return sink.write("\n)\n");
}

}  // namespace vorpipe
