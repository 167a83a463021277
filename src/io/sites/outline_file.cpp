#include "io/sites/outline_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "base/try.h"
#include "io/base/coordinate_system.h"
#include "io/base/error.h"
#include "io/base/extension.h"
#include "io/base/feature_layer.h"
#include "io/base/geometry_bytes.h"
#include "io/base/input_file.h"
#include "io/base/json_parser.h"
#include "io/base/number.h"
#include "io/base/quoted.h"
#include "io/base/read_log.h"
#include "io/base/shapefile.h"
#include "io/base/wkt_tokens.h"
#include "io/sites/sites_reader.h"
#include "io/sites/table_builder.h"

namespace vorpipe {
namespace {

/// Adds a ring as in a file, with its first point repeated at its end, to the polygon begun last. The error
/// continues "FILE:LINE:COLUMN: ".
tl::expected<void, std::string> addRing(std::vector<Point> points, Outline& outline) {
  constexpr std::size_t fewest = 4;
  if (points.size() < fewest) {
    return tl::unexpected(fmt::format(
        "the ring has {} positions; it needs {} or more, the last like the first", points.size(), fewest));
  }
  const Point first = points.front(), last = points.back();
  if (first.x != last.x || first.y != last.y) {
    return tl::unexpected(fmt::format("the ring is not closed: it begins at {} {} and ends at {} {}", first.x,
                                      first.y, last.x, last.y));
  }
  if (outline.ring_offsets.empty()) {
    outline.ring_offsets.push_back(0);
    outline.polygon_offsets.push_back(0);
  }
  outline.points.insert(outline.points.end(), points.begin(), points.end() - 1);
  outline.ring_offsets.push_back(outline.points.size());
  return {};
}

/// Ends a polygon, which consists of the rings since the last one.
void endPolygon(Outline& outline) {
  const std::size_t rings = outline.ring_offsets.empty() ? 0 : outline.ring_offsets.size() - 1;
  if (rings > 0 && rings > outline.polygon_offsets.back()) outline.polygon_offsets.push_back(rings);
}

/// An outline, feature by feature.
class OutlineFeatures {
 public:
  explicit OutlineFeatures(FeatureAttributes attributes)
      : attributes_(attributes == FeatureAttributes::kept) {}

  Outline& outline() { return outline_; }
  AttributeColumns& attributes() { return attributes_; }

  void endFeature() {
    polygons_.push_back(polygons());
    attributes_.endRow();
  }

  OutlineFile take(CoordinateSystem system = {}) {
    // Geometries that are in no feature are one.
    if (polygons_.back() < polygons()) endFeature();
    return {std::move(outline_), std::move(system), std::move(polygons_), attributes_.take()};
  }

 private:
  [[nodiscard]] std::uint64_t polygons() const {
    return outline_.polygon_offsets.empty() ? 0 : outline_.polygon_offsets.size() - 1;
  }

  Outline outline_;
  AttributeColumns attributes_;
  std::vector<std::uint64_t> polygons_ = {0};
};

/// An error and the path to it.
using Problem = std::optional<std::string>;

class OutlineJson {
 public:
  explicit OutlineJson(OutlineFeatures& features) : features_(features), outline_(features.outline()) {}

  Problem object(const nlohmann::ordered_json& value, const std::string& path, int depth = 0) {
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
    const auto inner = [&](const nlohmann::ordered_json& at, const std::string& its_path) {
      return object(at, its_path, depth + 1);
    };
    if (name == "Feature") {
      // A feature may have no geometry, such as an empty cell.
      const auto geometry = value.find("geometry");
      const bool none = geometry != value.end() && geometry->is_null();
      if (auto problem = none ? Problem{} : member(value, path, "geometry", inner)) return problem;
      setProperties(features_.attributes(), value);
      features_.endFeature();
      return {};
    }
    if (name == "FeatureCollection") return each(value, path, "features", inner);
    if (name == "GeometryCollection") return each(value, path, "geometries", inner);
    return wrong(path, fmt::format("is a {}; a Polygon or MultiPolygon is needed", inQuotes(name)));
  }

 private:
  static std::string wrong(const std::string& path, const std::string& what) {
    return fmt::format("{}: {}", path.empty() ? "the top object" : path, what);
  }

  template <class Take>
  static Problem member(const nlohmann::ordered_json& value, const std::string& path, const char* name,
                        const Take& take) {
    const auto found = value.find(name);
    if (found == value.end()) return wrong(path, fmt::format("has no \"{}\"", name));
    return take(*found, path.empty() ? std::string(name) : fmt::format("{}.{}", path, name));
  }

  template <class Take>
  static Problem elements(const nlohmann::ordered_json& list, const std::string& path, const Take& take) {
    if (!list.is_array()) return wrong(path, fmt::format("a {}, not an array", list.type_name()));
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (auto problem = take(list[k], fmt::format("{}[{}]", path, k))) return problem;
    }
    return {};
  }

  template <class Take>
  static Problem each(const nlohmann::ordered_json& value, const std::string& path, const char* name,
                      const Take& take) {
    return member(value, path, name, [&](const nlohmann::ordered_json& list, const std::string& its_path) {
      return elements(list, its_path, take);
    });
  }

  Problem polygon(const nlohmann::ordered_json& rings, const std::string& path) {
    auto problem =
        elements(rings, path, [&](const nlohmann::ordered_json& list, const std::string& its_path) {
          return ring(list, its_path);
        });
    if (!problem) endPolygon(outline_);
    return problem;
  }

  Problem ring(const nlohmann::ordered_json& positions, const std::string& path) {
    if (!positions.is_array()) return wrong(path, fmt::format("a {}, not an array", positions.type_name()));
    std::vector<Point> points;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const nlohmann::ordered_json& position = positions[k];
      const bool numbers =
          position.is_array() && position.size() >= 2 && position[0].is_number() && position[1].is_number();
      if (!numbers)
        return wrong(fmt::format("{}[{}]", path, k), "no position: two numbers or more are needed");
      points.push_back({position[0].get<double>(), position[1].get<double>()});
    }
    const auto added = addRing(std::move(points), outline_);
    return added ? Problem{} : wrong(path, added.error());
  }

  OutlineFeatures& features_;
  Outline& outline_;
};

Result<OutlineFile> readGeoJsonOutline(InputFile file, FeatureAttributes attributes) {
  JsonBytes bytes(file);
  VORPIPE_LET(value, parseJson<nlohmann::ordered_json>(bytes));
  auto system = systemOfGeoJson(value);
  const auto wrong = [&](const std::string& problem) {
    return inputError(fmt::format("{}: {}", file.name(), problem));
  };
  if (!system) return wrong(system.error());
  OutlineFeatures features(attributes);
  if (const auto problem = OutlineJson(features).object(value, {})) return wrong(*problem);
  return features.take(std::move(*system));
}

/// One object on each line.
Result<OutlineFile> readGeoJsonLinesOutline(InputFile file, FeatureAttributes attributes) {
  LineReader lines(std::move(file));
  OutlineFeatures features(attributes);
  const auto add = [&](const nlohmann::ordered_json& value) {
    return OutlineJson(features).object(value, {});
  };
  return eachJsonLine<nlohmann::ordered_json>(lines, add).map([&] { return features.take(wgs84()); });
}

class OutlineWkt {
 public:
  explicit OutlineWkt(InputFile& file) : tokens_(file) {}

  Result<OutlineFile> all() {
    while (!tokens_.atEnd()) {
      if (auto problem = geometry()) return tokens_.refused(*problem);
    }
    OutlineFile read{std::move(outline_)};
    if (system_ && *system_ > 0) read.system = systemOfCode(*system_);
    return tokens_.end().map([&] { return std::move(read); });
  }

 private:
  WktProblem geometry(int depth = 0) {
    const WktPlace begin = tokens_.place();
    std::optional<std::int64_t> code;
    if (auto problem = tokens_.takeSystem(code)) return problem;
    if (code && system_ && code != system_)
      return wrongAt(begin, fmt::format("is of SRID {}, and those before it of {}", *code, *system_));
    if (code) system_ = code;
    if (tokens_.takeType("MULTIPOLYGON")) return tokens_.takeList([&] { return polygon(); });
    if (tokens_.takeType("POLYGON")) return polygon();
    if (!tokens_.takeType("GEOMETRYCOLLECTION")) return tokens_.expected("POLYGON or MULTIPOLYGON");
    if (depth > most_nested_collections)
      return wrongAt(begin, fmt::format("stands in more than {} collections", most_nested_collections));
    return tokens_.takeList([&] { return geometry(depth + 1); });
  }

  WktProblem polygon() {
    auto problem = tokens_.takeList([&] { return ring(); });
    if (!problem) endPolygon(outline_);
    return problem;
  }

  WktProblem ring() {
    const WktPlace begin = tokens_.place();
    std::vector<Point> points;
    bool heights = false;
    const auto position = [&] { return tokens_.takePosition(points.emplace_back(), heights); };
    if (auto problem = tokens_.takeList(position)) return problem;
    const auto added = addRing(std::move(points), outline_);
    return added ? WktProblem{} : wrongAt(begin, added.error());
  }

  WktTokens tokens_;
  Outline outline_;
  std::optional<std::int64_t> system_;  ///< the code before geometries
};

Result<OutlineFile> readWktOutline(InputFile file, FeatureAttributes /*it has none*/) {
  return OutlineWkt(file).all();
}

/// Adds the polygons of the current row. The error states what is wrong with them.
tl::expected<void, std::string> addPolygons(const FeatureLayer& layer, Outline& outline) {
  const auto geometry = layer.geometry();
  if (!geometry) return {};
  std::vector<PolygonRings> polygons;
  VORPIPE_TRY(takeGeometryPolygons(*geometry, polygons));
  for (PolygonRings& rings : polygons) {
    for (auto& ring : rings) {
      VORPIPE_TRY(addRing(std::move(ring), outline));
    }
    endPolygon(outline);
  }
  return {};
}

/// Sets the attributes of the current row; `columns` are those of the layer's.
void setAttributes(const FeatureLayer& layer, std::span<const std::size_t> columns,
                   OutlineFeatures& features) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto value = layer.value(k);
    if (!value) continue;
    const auto& [type, text] = *value;
    const bool other = type == AttributeType::text && !isUtf8(text);
    features.attributes().set(columns[k], type, other ? fromWindows1252(text) : text);
  }
}

/// Reads a layer of a database, which is no stream.
Result<OutlineFile> readLayer(const std::string& path, FeatureLayer& layer, FeatureAttributes kept) {
  OutlineFeatures features(kept);
  std::vector<std::size_t> columns;
  for (const LayerColumn& column : layer.columns()) {
    columns.push_back(features.attributes().newColumn(column.name));
    features.attributes().setType(columns.back(), column.type);
  }
  for (std::uint64_t row = 1;; ++row) {
    VORPIPE_LET(more, layer.next());
    if (!more) return features.take(layer.system());
    if (const auto added = addPolygons(layer, features.outline()); !added) {
      return inputError(
          fmt::format("{}: layer {}, row {}: {}", path, printable(layer.name()), row, added.error()));
    }
    if (kept == FeatureAttributes::kept) setAttributes(layer, columns, features);
    features.endFeature();
  }
}

/// `name` is that of a layer; empty: the only one of polygons.
Result<OutlineFile> readGeoPackageOutline(const std::string& path, const std::string& name,
                                          FeatureAttributes attributes) {
  VORPIPE_VAR(layer, FeatureLayer::open(path, name, LayerOf::polygons));
  return readLayer(path, layer, attributes);
}

Result<OutlineFile> readShapefileOutline(const std::string& path, FeatureAttributes attributes) {
  VORPIPE_LET(converted, ConvertedShapefile::of(path));
  const ReadLog::Pause pause;
  VORPIPE_VAR(layer, FeatureLayer::open(path, {}, LayerOf::polygons, converted.file()));
  return readLayer(path, layer, attributes);
}

struct OutlineKind {
  std::string_view extension;
  Result<OutlineFile> (*read)(InputFile file, FeatureAttributes attributes);
};

/// The kind with layers. It is no stream of bytes, and neither are shapefiles.
constexpr std::string_view packaged = ".gpkg";

constexpr std::array<OutlineKind, 8> outline_kinds = {{{".geojson", readGeoJsonOutline},
                                                       {".json", readGeoJsonOutline},
                                                       {".geojsonl", readGeoJsonLinesOutline},
                                                       {".geojsons", readGeoJsonLinesOutline},
                                                       {".ndjson", readGeoJsonLinesOutline},
                                                       {".wkt", readWktOutline},
                                                       {packaged, nullptr},
                                                       {shapefile_extension, nullptr}}};

Result<OutlineFile> readOutlineKind(const OutlineKind& kind, const std::string& path,
                                    const std::string& layer, FeatureAttributes attributes) {
  if (kind.extension == packaged) return readGeoPackageOutline(path, layer, attributes);
  if (!layer.empty()) return inputError(fmt::format("{}: has no layers; a {} has", path, packaged));
  if (kind.read == nullptr) return readShapefileOutline(path, attributes);
  VORPIPE_VAR(file, InputFile::open(path));
  return kind.read(std::move(file), attributes);
}

/// Whether GeoJSON's coordinates may be degrees: the format has no others, but files may hold meters of a
/// plane.
bool mayBeDegrees(const Outline& outline) {
  constexpr double most_x = 360, most_y = 90;
  return std::ranges::all_of(
      outline.points, [](Point point) { return std::abs(point.x) <= most_x && std::abs(point.y) <= most_y; });
}

Result<OutlineFile> readByExtension(const std::string& path, const std::string& layer,
                                    FeatureAttributes attributes) {
  const auto* const kind = std::ranges::find(outline_kinds, inputExtension(path), &OutlineKind::extension);
  if (kind == outline_kinds.end()) {
    return inputError(
        fmt::format("{}: unknown kind of file; known are {}", path, fmt::join(outlineExtensions(), ", ")));
  }
  auto read = readOutlineKind(*kind, path, layer, attributes);
  if (!read) return read;
  if (read->outline.empty()) return inputError(path + ": holds no polygon");
  if (read->system.kind == CoordinateKind::degrees && !mayBeDegrees(read->outline)) read->system = {};
  VORPIPE_TRY(readSystemBeside(path, read->system));
  return read;
}

}  // namespace

std::vector<std::string> outlineExtensions() {
  std::vector<std::string> extensions;
  for (const OutlineKind& kind : outline_kinds) extensions.emplace_back(kind.extension);
  return extensions;
}

Result<OutlineFile> readOutline(const std::string& path, const std::string& layer,
                                FeatureAttributes attributes) {
  try {
    return readByExtension(path, layer, attributes);
  } catch (const std::bad_alloc&) {
    return deviceError(path + ": there is not enough memory for its polygons");
  }
}

}  // namespace vorpipe
