#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/geometry_bytes.h"
#include "io/base/json_parser.h"
#include "io/base/quoted.h"
#include "io/sites/site_columns.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"

namespace vorpipe {
namespace {

using Json = nlohmann::ordered_json;

/// Most different properties of all features; each is a column.
constexpr std::size_t most_properties = 2000;

std::string wrong(const std::string& path, std::string_view what) {
  return fmt::format("{}{}{}", path, path.empty() ? "" : ": ", what);
}

std::string inside(const std::string& path, std::string_view member) {
  return path.empty() ? std::string(member) : fmt::format("{}.{}", path, member);
}

/// Names a geometry that is no point, for messages.
std::string named(const std::string& type) {
  constexpr std::array<std::string_view, 4> known = {"LineString", "MultiLineString", "Polygon",
                                                     "MultiPolygon"};
  return std::ranges::find(known, type) == known.end() ? inQuotes(type) : type;
}

const std::string* typeOf(const Json& object) {
  const auto type = object.find("type");
  return type != object.end() && type->is_string() ? &type->get_ref<const std::string&>() : nullptr;
}

AttributeType attributeType(const Json& value) {
  if (value.is_string()) return AttributeType::text;
  if (value.is_boolean()) return AttributeType::boolean;
  if (value.is_number_float()) return AttributeType::real;
  if (value.is_number()) return isJsonInteger(value.dump()) ? AttributeType::integer : AttributeType::real;
  return AttributeType::json;
}

/// What is wrong, after the path to it.
using GeoJsonProblem = std::optional<std::string>;

void setProperty(AttributeColumns& attributes, const std::string& name, const Json& value) {
  const std::size_t column = attributes.column(name);
  if (value.is_null() || !attributes.kept()) return;
  if (value.is_string()) {
    attributes.set(column, AttributeType::text, value.get_ref<const std::string&>());
  } else {
    attributes.set(column, attributeType(value), value.dump());
  }
}

/// Takes sites from parsed GeoJSON, one feature or geometry after the other.
class GeoJsonPoints {
 public:
  explicit GeoJsonPoints(TableBuilder& table) : table_(table) {}

  /// Adds the sites of a Feature, or of a geometry: a Point, a MultiPoint, or a GeometryCollection of them.
  /// `path` is its path in the file, `line` its line if it is one.
  GeoJsonProblem add(const Json& object, const std::string& path, std::uint64_t line = 0) {
    line_ = line;
    points_.clear();
    weight_.reset();
    weight_name_.clear();
    if (!object.is_object()) return wrong(path, fmt::format("a {}, not an object", object.type_name()));
    const std::string* const type = typeOf(object);
    if (type == nullptr) return wrong(path, "has no \"type\" that is a string");
    if (*type == "Feature") return addFeature(object, path);
    if (*type == "FeatureCollection") return wrong(path, "a FeatureCollection where a Feature is needed");
    if (auto problem = takeGeometry(object, path, 0)) return problem;
    return endRow(path);
  }

 private:
  GeoJsonProblem addFeature(const Json& feature, const std::string& path) {
    const auto geometry = feature.find("geometry");
    if (geometry == feature.end()) return wrong(path, "has no \"geometry\"");
    if (!geometry->is_null()) {
      if (!geometry->is_object()) {
        return wrong(inside(path, "geometry"), fmt::format("a {}, not an object", geometry->type_name()));
      }
      if (auto problem = takeGeometry(*geometry, path, 0)) return problem;
    }
    if (auto problem = takeProperties(feature, path)) return problem;
    return endRow(path);
  }

  GeoJsonProblem endRow(const std::string& path) {
    RowProblem problem;
    if (points_.empty()) {
      problem = table_.addMissing("has no place; --missing skip leaves such out");
    } else if (!weight_name_.empty() && !weight_) {
      problem =
          table_.addMissing(fmt::format("its {} is null; --missing skip leaves such out", weight_name_));
    } else {
      table_.setPlace([&] { return line_ == 0 ? path : fmt::format("line {}", line_); });
      problem = table_.addRow(points_, weight_);
    }
    return problem ? wrong(path, *problem) : GeoJsonProblem{};
  }

  GeoJsonProblem takeGeometry(const Json& geometry, const std::string& path, int depth) {
    const std::string* const type = typeOf(geometry);
    if (type == nullptr) return wrong(path, "its geometry has no \"type\" that is a string");
    if (depth > most_nested_collections)
      return wrong(path, fmt::format("stands in more than {} collections", most_nested_collections));
    const bool several = *type == "MultiPoint", collection = *type == "GeometryCollection";
    if (!several && !collection && *type != "Point") {
      return wrong(path, fmt::format("a {} where a Point is needed", named(*type)));
    }
    const char* const name = collection ? "geometries" : "coordinates";
    const auto list = geometry.find(name);
    if (list == geometry.end() || !list->is_array())
      return wrong(path, fmt::format("has no array \"{}\"", name));
    if (!several && !collection) return list->empty() ? GeoJsonProblem{} : takePosition(*list, path);
    for (std::size_t k = 0; k < list->size(); ++k) {
      const Json& item = (*list)[k];
      const std::string its_path = inside(path, fmt::format("{}[{}]", name, k));
      if (collection && !item.is_object())
        return wrong(its_path, fmt::format("a {}, not an object", item.type_name()));
      auto problem = collection ? takeGeometry(item, its_path, depth + 1) : takePosition(item, its_path);
      if (problem) return problem;
    }
    return {};
  }

  GeoJsonProblem takePosition(const Json& position, const std::string& path) {
    const bool numbers =
        position.is_array() && position.size() >= 2 && position[0].is_number() && position[1].is_number();
    if (!numbers) return wrong(path, "no position: two numbers or more are needed");
    if (position.size() > 2) table_.noteHeights();
    points_.push_back({position[0].get<double>(), position[1].get<double>()});
    return {};
  }

  GeoJsonProblem takeProperties(const Json& feature, const std::string& path) {
    const auto properties = feature.find("properties");
    const bool none = properties == feature.end() || properties->is_null();
    if (!none && !properties->is_object()) {
      return wrong(inside(path, "properties"), fmt::format("a {}, not an object", properties->type_name()));
    }
    const auto id = feature.find("id");
    if (id != feature.end() && !id->is_null() && (none || !properties->contains("id")))
      setProperty(table_.attributes(), "id", *id);
    if (none) return {};
    for (const auto& [name, value] : properties->items()) {
      const auto kind = weightNamed(name, false);
      if (!kind) {
        setProperty(table_.attributes(), name, value);
      } else if (auto problem = takeWeight(name, *kind, value, path)) {
        return problem;
      }
    }
    if (table_.attributes().size() <= most_properties) return {};
    return wrong(path, fmt::format("features have more than {} different properties", most_properties));
  }

  GeoJsonProblem takeWeight(const std::string& name, WeightKind kind, const Json& value,
                            const std::string& path) {
    if (!weight_name_.empty()) {
      return wrong(path, fmt::format("has both {} and {}; keep one", inQuotes(weight_name_), inQuotes(name)));
    }
    weight_name_ = name;
    if (value.is_null()) return {};
    const std::string its_path = inside(path, "properties." + name);
    if (!value.is_number()) return wrong(its_path, fmt::format("a {}, not a number", value.type_name()));
    const auto weight = weightOf(kind, value.get<double>(), value.dump());
    if (!weight) return wrong(its_path, weight.error());
    weight_ = *weight;
    const bool exact = name == "weight" || name == "radius";
    if (!exact && !std::exchange(weight_noted_, true)) {
      table_.note(fmt::format("the property {} is taken as {}", inQuotes(name), meaningOf(kind)));
    }
    return {};
  }

  TableBuilder& table_;
  std::vector<Point> points_;     ///< of the feature
  std::optional<double> weight_;  ///< of the feature
  std::uint64_t line_ = 0;        ///< of the feature; 0: its path says where it is
  std::string weight_name_;       ///< of the feature; empty if it has none
  bool weight_noted_ = false;
};

/// Takes each member of the top object's list of features, or of geometries.
class Stream {
 public:
  Stream(JsonBytes& bytes, GeoJsonPoints& points) : bytes_(bytes), points_(points) {}

  // Called by JsonBuilder.
  bool isList(std::string_view member) {
    const bool list = member == "features" || member == "geometries";
    if (list && !list_.empty()) bytes_.stop(bytes_.errorAt(0, "is a second list of features or geometries"));
    if (list) list_ = member;
    return list;
  }
  void take(const Json& item) {
    const auto problem = points_.add(item, fmt::format("{}[{}]", list_, count_++));
    if (problem) bytes_.stop(inputError(fmt::format("{}: {}", bytes_.name(), *problem)));
  }

  /// Name of the list taken; empty if there was none.
  [[nodiscard]] const std::string& list() const { return list_; }

 private:
  JsonBytes& bytes_;
  GeoJsonPoints& points_;
  std::string list_;
  std::uint64_t count_ = 0;
};

/// Adds the top object, whose `list` was already taken. Returns what is wrong with it, if anything.
GeoJsonProblem addTop(const Json& top, const std::string& list, GeoJsonPoints& points, TableBuilder& table) {
  auto system = systemOfGeoJson(top);
  if (!system) return system.error();
  table.system() = std::move(*system);
  const auto type = top.is_object() ? top.find("type") : top.end();
  const bool named = top.is_object() && type != top.end() && type->is_string();
  const std::string name = named ? type->get<std::string>() : std::string();
  const std::string expected = name == "FeatureCollection"    ? "features"
                               : name == "GeometryCollection" ? "geometries"
                                                              : "";
  if (list != expected) {
    return list.empty() ? fmt::format("the top object: has no array \"{}\"", expected)
                        : fmt::format("the top object: has \"{}\", and is no collection of them", list);
  }
  if (!list.empty()) return {};
  return points.add(top, top.is_object() ? "" : "the top object");
}

}  // namespace

void setProperties(AttributeColumns& attributes, const Json& feature) {
  const auto properties = feature.find("properties"), id = feature.find("id");
  const bool some = properties != feature.end() && properties->is_object();
  if (id != feature.end() && (!some || !properties->contains("id"))) setProperty(attributes, "id", *id);
  if (!some) return;
  for (const auto& [name, value] : properties->items()) setProperty(attributes, name, value);
}

tl::expected<CoordinateSystem, std::string> systemOfGeoJson(const Json& top) {
  const auto member = top.is_object() ? top.find("crs") : top.end();
  if (!top.is_object() || member == top.end() || member->is_null()) return wgs84();
  const Json& crs = *member;
  const Json* name = nullptr;
  if (crs.is_object() && crs.contains("properties") && crs["properties"].is_object()) {
    const Json& properties = crs["properties"];
    const auto found = properties.find("name");
    if (found != properties.end() && found->is_string()) name = &*found;
  }
  if (name == nullptr) return tl::unexpected(std::string("crs: has no \"properties\" with a \"name\""));
  const auto& text = name->get_ref<const std::string&>();
  auto system = systemNamed(text);
  if (!system) return tl::unexpected(fmt::format("crs: {}", system.error()));
  return system;
}

Result<SiteTable> readGeoJsonSites(InputFile file, const ReadOptions& options) {
  TableBuilder table(file.name(), options);
  GeoJsonPoints points(table);
  JsonBytes bytes(file);
  Stream stream(bytes, points);
  VORPIPE_LET(top, parseJson<Json>(bytes, stream));
  if (const auto problem = addTop(top, stream.list(), points, table)) {
    return inputError(fmt::format("{}: {}", file.name(), *problem));
  }
  return table.finish();
}

Result<SiteTable> readGeoJsonLines(InputFile file, const ReadOptions& options) {
  LineReader lines(std::move(file));
  TableBuilder table(lines.name(), options);
  table.system() = wgs84();
  GeoJsonPoints points(table);
  return eachJsonLine<Json>(lines, [&](const Json& value) { return points.add(value, "", lines.number()); })
      .map([&] { return table.finish(); });
}

}  // namespace vorpipe
