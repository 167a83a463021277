/// Files with sites, weights and masses.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/base/geometry_bytes.h"
#include "io/cells/points_file.h"
#include "io/sites/sites_file.h"
#include "io/sites/weights_file.h"
#include "target.h"

namespace vorpipe::fuzz {
namespace {

/// Options that an input is read with: its length says which, so that any file is a seed.
ReadOptions optionsFor(std::string_view bytes, std::string_view format) {
  static const std::array<std::vector<std::string>, 4> columns = {
      {{}, {"x", "y"}, {"1", "2", "3"}, {"geometry"}}};
  ReadOptions options;
  options.format = format;
  options.skip_missing = bytes.size() % 2 == 1;
  options.attributes = bytes.size() % 5 != 0;
  const bool table = format == "csv" || format == "tsv" || format == "txt" || format == "npy";
  if (table && bytes.size() % 3 == 1) options.columns = columns[bytes.size() / 3 % columns.size()];
  return options;
}

void requireWhole(const SiteTable& table) {
  const Sites& sites = table.sites;
  require(sites.size() > 0, "a file without sites is refused");
  require(sites.x.size() == sites.y.size(), "each site has x and y");
  require(sites.weight.empty() || sites.weight.size() == sites.size(),
          "all sites have a weight, or none has");
  const auto finite = [](double value) { return std::isfinite(value); };
  require(std::ranges::all_of(sites.x, finite) && std::ranges::all_of(sites.y, finite) &&
              std::ranges::all_of(sites.weight, finite),
          "coordinates and weights are finite");
  for (const Attribute& attribute : table.attributes) {
    require(attribute.size() == sites.size(), "attributes are as long as the sites");
    for (std::size_t site = 0; site < sites.size(); ++site) (void)attribute.at(site);
  }
}

/// Of GeoJSON, more properties than this are written and not read (docs/formats.md).
constexpr std::size_t most_properties = 2000;

/// What is written of sites is read again as the same sites, with as many attributes.
void requireReadBack(const SiteTable& table) {
  for (const std::string_view format : {"csv", "geojson"}) {
    const auto kind = pointsFormatOf("points." + std::string(format));
    require(kind.has_value(), "the format is known");
    MemorySink text("points");
    const PointsOutput output{table.sites, table.attributes, table.system};
    require(writePoints(text, output, **kind).has_value(), "sites can be written");
    ReadOptions options;
    options.format = format;
    const std::string& path = fileOf("again", text.bytes());
    const auto again = readSites(path, options);
    if (format == "geojson" && table.attributes.size() >= most_properties) {
      if (!again) requireTold(again.error(), path);
      continue;
    }
    require(again.has_value(), "what was written is read: " + (again ? "" : again.error().message));
    require(again->sites.x == table.sites.x && again->sites.y == table.sites.y, "sites come back the same");
  }
}

void fuzzSites(std::string_view bytes, std::string_view format) {
  const std::string& path = fileOf(format, bytes);
  const auto table = readSites(path, optionsFor(bytes, format));
  if (!table) return requireTold(table.error(), path);
  requireWhole(*table);
  requireReadBack(*table);
}

}  // namespace

void fuzzCsv(std::string_view bytes) { fuzzSites(bytes, bytes.size() % 7 == 0 ? "tsv" : "csv"); }
void fuzzText(std::string_view bytes) { fuzzSites(bytes, "txt"); }
void fuzzNpy(std::string_view bytes) { fuzzSites(bytes, "npy"); }
void fuzzGeoJson(std::string_view bytes) { fuzzSites(bytes, "geojson"); }
void fuzzGeoJsonLines(std::string_view bytes) { fuzzSites(bytes, "geojsonl"); }
void fuzzWkt(std::string_view bytes) { fuzzSites(bytes, "wkt"); }
void fuzzGeoPackage(std::string_view bytes) { fuzzSites(bytes, "gpkg"); }

void fuzzGeometry(std::string_view bytes) {
  std::vector<Point> points;
  bool others = false;
  if (!takeGeometryPoints(bytes, points, others)) return;
  require(points.size() <= bytes.size() / (2 * sizeof(double)), "no more points than bytes hold");
  for (const Point& point : points)
    require(std::isfinite(point.x) && std::isfinite(point.y), "points are finite");
}

void fuzzWeights(std::string_view bytes) {
  constexpr std::uint64_t count = 3;
  constexpr std::array<std::string_view, 3> kinds = {"csv", "txt", "npy"};
  const bool array = bytes.starts_with("\x93NUMPY");
  const std::string& path = fileOf(array ? "npy" : kinds[bytes.size() % 2], bytes);
  const auto weights = readWeights(path, count);
  if (!weights) return requireTold(weights.error(), path);
  require(weights->size() == count, "there are as many weights as sites");
  for (const double weight : *weights) require(std::isfinite(weight), "weights are finite");
}

void fuzzMasses(std::string_view bytes) {
  constexpr std::uint64_t count = 2;
  const std::string& path = fileOf(bytes.starts_with("\x93NUMPY") ? "npy" : "csv", bytes);
  const auto masses = readMasses(path, count);
  if (!masses) return requireTold(masses.error(), path);
  require(masses->size() == count, "there are as many masses as sites");
  for (const double mass : *masses) require(std::isfinite(mass) && mass > 0, "masses are more than 0");
}

}  // namespace vorpipe::fuzz
