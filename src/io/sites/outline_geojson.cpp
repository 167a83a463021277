#include <fmt/core.h>

#include <optional>
#include <utility>

#include "io/base/error.h"
#include "io/base/geojson_nesting.h"
#include "io/base/json_lines.h"
#include "io/base/quoted.h"
#include "io/sites/geojson_points.h"
#include "io/sites/outline_reader.h"

namespace vorpipe {
namespace {

using json = nlohmann::ordered_json;

/// An error and the path to it.
using Problem = std::optional<std::string>;

class GeoJson {
 public:
  explicit GeoJson(Outline& outline) : outline_(outline) {}

  Problem object(const json& value, const std::string& path, int depth = 0) {
    if (!value.is_object()) return wrong(path, fmt::format("a {}, not an object", value.type_name()));
    const auto type = value.find("type");
    if (type == value.end() || !type->is_string()) return wrong(path, "has no \"type\" that is a string");
    const auto& name = type->get_ref<const std::string&>();
    if (depth > most_nested_collections)
      return wrong(path, fmt::format("stands in more than {} collections", most_nested_collections));
    if (name == "Polygon")
      return member(value, path, "coordinates", [&](auto&&... at) { return polygon(at...); });
    if (name == "MultiPolygon") {
      return each(value, path, "coordinates", [&](auto&&... at) { return polygon(at...); });
    }
    const auto inner = [&](const json& at, const std::string& its_path) {
      return object(at, its_path, depth + 1);
    };
    if (name == "Feature") {
      // A feature may have no geometry, such as an empty cell.
      const auto geometry = value.find("geometry");
      if (geometry != value.end() && geometry->is_null()) return {};
      return member(value, path, "geometry", inner);
    }
    if (name == "FeatureCollection") return each(value, path, "features", inner);
    if (name == "GeometryCollection") return each(value, path, "geometries", inner);
    return wrong(path, fmt::format("is a {}; a Polygon or MultiPolygon is needed", vorpipe::inQuotes(name)));
  }

 private:
  static std::string wrong(const std::string& path, const std::string& what) {
    return fmt::format("{}: {}", path.empty() ? "the top object" : path, what);
  }

  template <class Take>
  static Problem member(const json& value, const std::string& path, const char* name, const Take& take) {
    const auto found = value.find(name);
    if (found == value.end()) return wrong(path, fmt::format("has no \"{}\"", name));
    return take(*found, path.empty() ? std::string(name) : fmt::format("{}.{}", path, name));
  }

  template <class Take>
  static Problem elements(const json& list, const std::string& path, const Take& take) {
    if (!list.is_array()) return wrong(path, fmt::format("a {}, not an array", list.type_name()));
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (auto problem = take(list[k], fmt::format("{}[{}]", path, k))) return problem;
    }
    return {};
  }

  template <class Take>
  static Problem each(const json& value, const std::string& path, const char* name, const Take& take) {
    return member(value, path, name, [&](const json& list, const std::string& its_path) {
      return elements(list, its_path, take);
    });
  }

  Problem polygon(const json& rings, const std::string& path) {
    auto problem = elements(
        rings, path, [&](const json& list, const std::string& its_path) { return ring(list, its_path); });
    if (!problem) endPolygon(outline_);
    return problem;
  }

  Problem ring(const json& positions, const std::string& path) {
    if (!positions.is_array()) return wrong(path, fmt::format("a {}, not an array", positions.type_name()));
    std::vector<Point> points;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const json& position = positions[k];
      const bool numbers =
          position.is_array() && position.size() >= 2 && position[0].is_number() && position[1].is_number();
      if (!numbers)
        return wrong(fmt::format("{}[{}]", path, k), "no position: two numbers or more are needed");
      points.push_back({position[0].get<double>(), position[1].get<double>()});
    }
    const auto added = addRing(std::move(points), outline_);
    return added ? Problem{} : wrong(path, added.error());
  }

  Outline& outline_;
};

}  // namespace

Result<OutlineFile> readGeoJsonOutline(InputFile file) {
  JsonBytes bytes(file);
  const auto value = parseJson<json>(bytes);
  if (!value) return tl::unexpected(value.error());
  OutlineFile read{{}, wgs84()};
  const auto wrong = [&](const std::string& problem) {
    return inputError(fmt::format("{}: {}", file.name(), problem));
  };
  if (value->is_object() && value->contains("crs")) {
    auto system = systemOfCrs((*value)["crs"]);
    if (!system) return wrong(system.error());
    read.system = std::move(*system);
  }
  if (const auto problem = GeoJson(read.outline).object(*value, {})) return wrong(*problem);
  return read;
}

Result<OutlineFile> readGeoJsonLinesOutline(InputFile file) {
  LineReader lines(std::move(file));
  OutlineFile read{{}, wgs84()};
  auto done =
      eachJsonLine<json>(lines, [&](const json& value) { return GeoJson(read.outline).object(value, {}); });
  if (!done) return tl::unexpected(std::move(done.error()));
  return read;
}

}  // namespace vorpipe
