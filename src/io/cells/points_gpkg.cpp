#include "io/base/attribute_fields.h"
#include "io/base/field_text.h"
#include "io/base/geopackage.h"
#include "io/cells/points_file.h"

namespace vorpipe {
namespace {

/// A GeoPackage with the layer `sites`, of Points; the weight if sites have one, then the attributes.
Result<void> writeGpkgPoints(ByteSink& sink, const PointsOutput& output) {
  const Sites& sites = output.sites;
  Layer layer{"sites", GeometryType::point, {}, output.system};
  if (!sites.weight.empty()) layer.fields.push_back({"weight", FieldType::real});
  const auto names = pointAttributeNames(output.attributes);
  for (std::size_t k = 0; k < names.size(); ++k) {
    layer.fields.push_back({utf8Of(names[k]), fieldType(output.attributes[k].type())});
  }
  Wkb wkb;
  return writeGeoPackage(sink, layer, sites.size(), [&](std::size_t site, FeatureRow& row) {
    wkb.clear();
    wkb.addPoint({sites.x[site], sites.y[site]});
    row.setGeometry(wkb);
    if (!sites.weight.empty()) row.add(sites.weight[site]);
    for (const Attribute& attribute : output.attributes) addValue(row, attribute, site);
    return true;
  });
}

}  // namespace

extern const PointsFormat gpkg_points;
const PointsFormat gpkg_points{
    .extension = ".gpkg", .write = writeGpkgPoints, .attributes = true, .in_memory = true};

}  // namespace vorpipe
