#include <string>
#include <vector>

#include "io/base/attribute_fields.h"
#include "io/base/geopackage.h"
#include "io/cells/cell_attributes.h"
#include "io/cells/cell_polygons.h"
#include "io/cells/cells_writers.h"

namespace vorpipe {
namespace {

std::vector<LayerField> fieldsOf(const CellsOutput& output) {
  const Diagram& diagram = output.diagram;
  std::vector<LayerField> fields;
  const auto add = [&](FieldType type, std::initializer_list<const char*> names) {
    for (const char* name : names) fields.push_back({name, type});
  };
  add(FieldType::integer, {"site"});
  add(FieldType::real, {"x", "y"});
  if (!output.sites.weight.empty()) add(FieldType::real, {"weight"});
  add(FieldType::text, {"status"});
  add(FieldType::integer, {"owner"});
  add(FieldType::real, {"area", "perimeter", "centroid_x", "centroid_y"});
  if (!diagram.mass.empty()) add(FieldType::real, {"mass", "mass_centroid_x", "mass_centroid_y"});
  add(FieldType::integer, {"vertices"});
  add(FieldType::text, {"neighbors"});
  if (!diagram.neighbor_shifts.empty()) add(FieldType::text, {"neighbor_shifts"});
  if (!diagram.ring_starts.empty()) add(FieldType::integer, {"rings"});
  addAttributeFields(fields, output.attributes, attributeNames(output.attributes));
  return fields;
}

/// The rows of the layer, filled in the order of fieldsOf().
class Rows {
 public:
  explicit Rows(const CellsOutput& output) : output_(output) {}

  bool fill(std::size_t site, FeatureRow& row) {
    const CellPolygons cell(output_.diagram, site, output_.system);
    if (cell.empty() && output_.only_cells) return false;
    if (!cell.empty()) setPolygons(row, cell);
    addFields(row, site);
    for (const Attribute& attribute : output_.attributes) addValue(row, attribute, site);
    return true;
  }

 private:
  void setPolygons(FeatureRow& row, const CellPolygons& cell) {
    wkb_.clear();
    wkb_.begin(GeometryType::multi_polygon, cell.size());
    for (std::size_t p = 0; p < cell.size(); ++p) {
      wkb_.begin(GeometryType::polygon, cell[p].size());
      for (const auto vertices : cell[p]) {
        wkb_.beginRing(vertices.size() + 1);
        for (const Point& vertex : vertices) wkb_.add(vertex);
        wkb_.add(vertices.front());
      }
    }
    row.setGeometry(wkb_);
  }

  template <class Print>
  void addText(FeatureRow& row, std::size_t site, const Print& print_text) {
    text_.clear();
    print_text(text_, output_.diagram, site);
    row.add(std::string_view(text_.data(), text_.size()));
  }

  void addFields(FeatureRow& row, std::size_t site) {
    const Sites& sites = output_.sites;
    const Diagram& diagram = output_.diagram;
    const auto addPoint = [&row](const Point& point) {
      row.add(point.x);
      row.add(point.y);
    };
    row.add(static_cast<std::int64_t>(site));
    addPoint({sites.x[site], sites.y[site]});
    if (!sites.weight.empty()) row.add(sites.weight[site]);
    row.add(statusWord(diagram.status[site]));
    row.add(std::int64_t{diagram.owner[site]});
    row.add(diagram.area[site]);
    row.add(diagram.perimeter[site]);
    addPoint(diagram.centroid[site]);
    if (!diagram.mass.empty()) {
      row.add(diagram.mass[site]);
      addPoint(diagram.mass_centroid[site]);
    }
    row.add(static_cast<std::int64_t>(diagram.cell(site).edges()));
    addText(row, site, printNeighbors);
    if (!diagram.neighbor_shifts.empty()) addText(row, site, printShifts);
    if (!diagram.ring_starts.empty()) row.add(static_cast<std::int64_t>(ringsOf(diagram, site).size()));
  }

  const CellsOutput& output_;
  Wkb wkb_;
  Bytes text_;
};

}  // namespace

Result<void> writeGpkgCells(ByteSink& sink, const CellsOutput& output) {
  const Layer layer{"cells", GeometryType::multi_polygon, fieldsOf(output), output.system};
  Rows rows(output);
  return writeGeoPackage(sink, layer, output.sites.size(),
                         [&](std::size_t site, FeatureRow& row) { return rows.fill(site, row); });
}

}  // namespace vorpipe
