#include "io/cells/points_file.h"

#include <array>
#include <cassert>
#include <new>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/field_text.h"
#include "io/base/geopackage.h"
#include "io/base/npy_array.h"
#include "io/base/number.h"
#include "io/base/print.h"
#include "io/cells/cell_attributes.h"

namespace vorpipe {
namespace {

/// Columns x,y, or lon,lat if the sites are in degrees; weight if they have one; then the attributes.
Result<void> writeCsvPoints(ByteSink& sink, const PointsOutput& output) {
  const Sites& sites = output.sites;
  const bool weighted = !sites.weight.empty();
  Bytes header;
  print(header, FMT_COMPILE("{}{}"), output.system.kind == CoordinateKind::degrees ? "lon,lat" : "x,y",
        weighted ? ",weight" : "");
  printCsvNames(header, pointAttributeNames(output.attributes));
  header.push_back('\n');
  VORPIPE_TRY(writeAll(sink, header));
  const auto put = [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE("{},{}"), sites.x[site], sites.y[site]);
    if (weighted) print(text, FMT_COMPILE(",{}"), sites.weight[site]);
    printCsvValues(text, output.attributes, site);
    text.push_back('\n');
  };
  return writeEach(sink, sites.size(), put, output.threads);
}

/// One site per line: x, y, and its weight if it has one.
Result<void> writeTxtPoints(ByteSink& sink, const PointsOutput& output) {
  const Sites& sites = output.sites;
  const auto put = [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE("{} {}"), sites.x[site], sites.y[site]);
    if (!sites.weight.empty()) print(text, FMT_COMPILE(" {}"), sites.weight[site]);
    text.push_back('\n');
  };
  return writeEach(sink, sites.size(), put, output.threads);
}

/// float64, a row for each site: x, y, and its weight if it has one.
Result<void> writeNpyPoints(ByteSink& sink, const PointsOutput& output) {
  const Sites& sites = output.sites;
  const bool weighted = !sites.weight.empty();
  const std::uint64_t shape[] = {sites.size(), weighted ? 3U : 2U};
  VORPIPE_TRY(sink.write(npyHeader(npyType<double>(), shape)));
  return writeEach(sink, sites.size(), [&](Bytes& bytes, std::size_t site) {
    appendNumber<std::endian::native>(bytes, sites.x[site]);
    appendNumber<std::endian::native>(bytes, sites.y[site]);
    if (weighted) appendNumber<std::endian::native>(bytes, sites.weight[site]);
  });
}

/// A Point for each site: its id is the site, its properties are its weight, if it has one, and the
/// attributes.
Result<void> writePointFeatures(ByteSink& sink, FeaturesAs as, const PointsOutput& output) {
  const Sites& sites = output.sites;
  const auto keys = jsonKeys(pointAttributeNames(output.attributes));
  const auto put = [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE(R"({{"type":"Feature","id":{},"properties":{{)"), site);
    if (!sites.weight.empty()) print(text, FMT_COMPILE(R"("weight":{})"), sites.weight[site]);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (k > 0 || !sites.weight.empty()) text.push_back(',');
      text.append(keys[k]);
      printJsonValue(text, output.attributes[k], site);
    }
    text.append(std::string_view(R"(},"geometry":{"type":"Point","coordinates":)"));
    printJsonPoint(text, {sites.x[site], sites.y[site]});
    text.append(std::string_view("}}"));
    return true;
  };
  return writeFeatures(sink, as, output.system, sites.size(), put, output.threads);
}

Result<void> writeGeojsonPoints(ByteSink& sink, const PointsOutput& output) {
  return writePointFeatures(sink, FeaturesAs::collection, output);
}

Result<void> writeGeojsonlPoints(ByteSink& sink, const PointsOutput& output) {
  return writePointFeatures(sink, FeaturesAs::lines, output);
}

/// A GeoPackage with the layer `sites`, of Points; the weight if sites have one, then the attributes.
Result<void> writeGpkgPoints(ByteSink& sink, const PointsOutput& output) {
  const Sites& sites = output.sites;
  Layer layer{"sites", GeometryType::point, {}, output.system};
  if (!sites.weight.empty()) layer.fields.push_back({"weight", AttributeType::real});
  addAttributeFields(layer.fields, output.attributes, pointAttributeNames(output.attributes));
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

/// One POINT per line.
Result<void> writeWktPoints(ByteSink& sink, const PointsOutput& output) {
  const auto put = [&](Bytes& text, std::size_t site) {
    print(text, FMT_COMPILE("POINT ({} {})\n"), output.sites.x[site], output.sites.y[site]);
  };
  return writeEach(sink, output.sites.size(), put, output.threads);
}

constexpr PointsFormat csv_points{".csv", writeCsvPoints, /*attributes=*/true},
    txt_points{".txt", writeTxtPoints}, npy_points{".npy", writeNpyPoints},
    geojson_points{".geojson", writeGeojsonPoints, /*attributes=*/true},
    geojsonl_points{".geojsonl", writeGeojsonlPoints, /*attributes=*/true},
    gpkg_points{".gpkg", writeGpkgPoints, /*attributes=*/true, /*in_memory=*/true},
    wkt_points{".wkt", writeWktPoints};
constexpr std::array points_formats{&csv_points,      &txt_points,  &npy_points, &geojson_points,
                                    &geojsonl_points, &gpkg_points, &wkt_points};
constexpr std::span<const PointsFormat* const> all_points_formats(points_formats);

}  // namespace

std::vector<std::string_view> pointsExtensions() { return extensionsOf(all_points_formats); }

Result<const PointsFormat*> pointsFormatOf(const std::string& path) {
  return formatFor(path, "sites", all_points_formats);
}

Result<void> writePoints(ByteSink& sink, const PointsOutput& output, const PointsFormat& format) {
  assert(output.sites.x.size() == output.sites.y.size());
  try {
    return format.write(sink, output);
  } catch (const std::bad_alloc&) {
    return deviceError(sink.name() + ": there is not enough memory to write its sites");
  }
}

}  // namespace vorpipe
