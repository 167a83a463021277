#include <span>
#include <string>
#include <vector>

#include "io/base/field_text.h"
#include "io/base/geopackage.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/cell_polygons.h"
#include "io/cells/cells_writers.h"

namespace vorpipe {
namespace {

std::vector<LayerField> fieldsOf(const CellsOutput& output, std::span<const AddedField> added) {
  const Diagram& diagram = output.diagram;
  std::vector<LayerField> fields;
  const auto add = [&](AttributeType type, std::initializer_list<const char*> names) {
    for (const char* name : names) fields.push_back({name, type});
  };
  add(AttributeType::integer, {"site"});
  add(AttributeType::real, {"x", "y"});
  if (!output.sites.weight.empty()) add(AttributeType::real, {"weight"});
  add(AttributeType::text, {"status"});
  add(output.names == nullptr ? AttributeType::integer : output.names->type(), {"owner"});
  add(AttributeType::real, {"area", "perimeter", "centroid_x", "centroid_y"});
  if (!diagram.mass.empty()) add(AttributeType::real, {"mass", "mass_centroid_x", "mass_centroid_y"});
  add(AttributeType::integer, {"vertices"});
  add(AttributeType::text, {"neighbors"});
  if (!diagram.neighbor_shifts.empty()) add(AttributeType::text, {"neighbor_shifts"});
  if (!diagram.ring_starts.empty()) add(AttributeType::integer, {"rings"});
  for (const AddedField& field : added) fields.push_back({std::string(field.name), AttributeType::real});
  addAttributeFields(fields, output.attributes, attributeNames(output.attributes, added));
  return fields;
}

/// Adds the values of a site in the order of fieldsOf().
void addFields(FeatureRow& row, const CellsOutput& output, std::span<const AddedField> added,
               std::size_t site) {
  const Sites& sites = output.sites;
  const Diagram& diagram = output.diagram;
  const auto addPoint = [&row](const Point& point) {
    row.add(point.x);
    row.add(point.y);
  };
  const auto addText = [&](auto printText, const auto& of) {
    Bytes text;
    printText(text, of, site);
    row.add(std::string_view(text.data(), text.size()));
  };
  row.add(static_cast<std::int64_t>(site));
  addPoint({sites.x[site], sites.y[site]});
  if (!sites.weight.empty()) row.add(sites.weight[site]);
  row.add(statusWord(diagram.status[site]));
  const std::uint32_t owner = diagram.owner[site];
  if (output.names == nullptr) {
    row.add(std::int64_t{owner});
  } else {
    addValue(row, *output.names, owner);
  }
  row.add(diagram.area[site]);
  row.add(diagram.perimeter[site]);
  addPoint(diagram.centroid[site]);
  if (!diagram.mass.empty()) {
    row.add(diagram.mass[site]);
    addPoint(diagram.mass_centroid[site]);
  }
  row.add(static_cast<std::int64_t>(diagram.cell(site).edges()));
  addText(printNeighbors, output);
  if (!diagram.neighbor_shifts.empty()) addText(printShifts, diagram);
  if (!diagram.ring_starts.empty()) row.add(static_cast<std::int64_t>(ringsOf(diagram, site).size()));
  for (const AddedField& field : added) row.add(diagram.area[site] / field.divisor);
  for (const Attribute& attribute : output.attributes) addValue(row, attribute, site);
}

}  // namespace

void setPolygons(FeatureRow& row, Wkb& wkb, const CellPolygons& cell) {
  wkb.clear();
  wkb.begin(GeometryType::multi_polygon, cell.size());
  for (std::size_t p = 0; p < cell.size(); ++p) {
    wkb.begin(GeometryType::polygon, cell[p].size());
    for (const auto vertices : cell[p]) {
      wkb.beginRing(vertices.size() + 1);
      for (const Point& vertex : vertices) wkb.add(vertex);
      wkb.add(vertices.front());
    }
  }
  row.setGeometry(wkb);
}

Result<void> writeGpkgCells(ByteSink& sink, const CellsOutput& output) {
  const auto added = addedFields(output);
  const Layer layer{"cells", GeometryType::multi_polygon, fieldsOf(output, added), output.system};
  Wkb wkb;
  return writeGeoPackage(sink, layer, output.sites.size(), [&](std::size_t site, FeatureRow& row) {
    const CellPolygons cell(output.sites, output.diagram, site, output.system);
    if (cell.empty() && output.only_cells) return false;
    if (!cell.empty()) setPolygons(row, wkb, cell);
    addFields(row, output, added, site);
    return true;
  });
}

}  // namespace vorpipe
