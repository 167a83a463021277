#include "io/cells/points_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <new>
#include <unordered_set>

#include "io/base/error.h"
#include "io/base/format_list.h"
#include "io/base/lower_case.h"

namespace vorpipe {

// One line for each kind of file: the name of what points_NAME.cpp defines, NAME_points.
// clang-format off
#define POINTS_FORMATS(format) \
  format(csv)                  \
  format(txt)                  \
  format(npy)                  \
  format(geojson)              \
  format(geojsonl)             \
  format(gpkg)                 \
  format(wkt)
// clang-format on

#define DECLARED(name) extern const PointsFormat name##_points;
POINTS_FORMATS(DECLARED)
#undef DECLARED

namespace {

#define LISTED(name) &name##_points,
constexpr std::array points_formats{POINTS_FORMATS(LISTED)};
#undef LISTED
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

std::vector<std::string> pointAttributeNames(std::span<const Attribute> attributes) {
  // Names that readers take for a position or a weight.
  std::unordered_set<std::string> taken{"",        "x",        "y",    "lon",       "lat",
                                        "weight",  "fid",      "geom", "w",         "r",
                                        "radius",  "lng",      "long", "longitude", "latitude",
                                        "easting", "northing", "wkt",  "geometry",  "the_geom"};
  std::vector<std::string> names;
  for (const Attribute& attribute : attributes) {
    std::string name = attribute.name();
    while (!taken.insert(lowerCase(name)).second) name.insert(0, "input_");
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace vorpipe
