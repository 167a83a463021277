#include "io/pictures/geo_keys.h"

#include <optional>
#include <utility>

// OGC GeoTIFF Standard 1.1 (19-008r4): 7.1 (the directory), and its Annex C for the projection.

namespace vorpipe {
namespace {

enum Key : std::uint16_t {
  model_type = 1024,
  raster_type = 1025,
  geodetic_crs = 2048,
  angular_units = 2054,
  projected_crs = 3072,
  projected_citation = 3073,
  projection = 3074,
  projection_method = 3075,
  linear_units = 3076,
  false_easting = 3082,
  false_northing = 3083,
  center_longitude = 3088,
  center_latitude = 3089,
};

constexpr std::uint16_t projected = 1, geographic = 2, pixel_is_area = 1, user_defined = 32767;
constexpr std::uint16_t wgs_84 = 4326, degree = 9102, kilometer = 9036, lambert_azimuthal_equal_area = 10;

/// Keys are added in ascending order.
class Builder {
 public:
  void add(Key key, std::uint16_t value) { entry(key, 0, 1, value); }
  void add(Key key, double value) {
    entry(key, geo_doubles_tag, 1, static_cast<std::uint16_t>(keys_.doubles.size()));
    keys_.doubles.push_back(value);
  }
  void add(Key key, const std::string& text) {
    entry(key, geo_ascii_tag, static_cast<std::uint16_t>(text.size() + 1),
          static_cast<std::uint16_t>(keys_.ascii.size()));
    keys_.ascii += text + '|';
  }
  GeoKeys take() && { return std::move(keys_); }

 private:
  void entry(Key key, std::uint16_t place, std::uint16_t count, std::uint16_t value) {
    keys_.directory.insert(keys_.directory.end(), {key, place, count, value});
    ++keys_.directory[3];
  }

  GeoKeys keys_{{1, 1, 1, 0}, {}, {}};  ///< versions, and the number of keys that follow
};

/// The EPSG code, if the file has room for it.
std::optional<std::uint16_t> codeOf(const CoordinateSystem& system) {
  if (system.organization != "EPSG" || system.code <= 0 || system.code >= user_defined) return std::nullopt;
  return static_cast<std::uint16_t>(system.code);
}

void addEqualArea(Builder& keys, const Point& center) {
  keys.add(geodetic_crs, wgs_84);
  keys.add(angular_units, degree);
  keys.add(projected_crs, user_defined);
  keys.add(projected_citation, std::string("Lambert azimuthal equal area, in kilometers"));
  keys.add(projection, user_defined);
  keys.add(projection_method, lambert_azimuthal_equal_area);
  keys.add(linear_units, kilometer);
  keys.add(false_easting, 0.0);
  keys.add(false_northing, 0.0);
  keys.add(center_longitude, center.x);
  keys.add(center_latitude, center.y);
}

}  // namespace

GeoKeys geoKeysOf(const CoordinateSystem& system) {
  const bool in_degrees = system.kind == CoordinateKind::degrees;
  const auto code = codeOf(system);
  if (!in_degrees && !system.equal_area_center && (system.kind != CoordinateKind::plane || !code)) return {};
  Builder keys;
  keys.add(model_type, in_degrees ? geographic : projected);
  keys.add(raster_type, pixel_is_area);
  if (in_degrees) {
    keys.add(geodetic_crs, code.value_or(wgs_84));
  } else if (system.equal_area_center) {
    addEqualArea(keys, *system.equal_area_center);
  } else {
    keys.add(projected_crs, *code);
  }
  return std::move(keys).take();
}

}  // namespace vorpipe
