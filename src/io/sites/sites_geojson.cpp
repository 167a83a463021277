#include <fmt/core.h>

#include <optional>
#include <string>
#include <utility>

#include "io/base/error.h"
#include "io/base/json_lines.h"
#include "io/sites/geojson_points.h"
#include "io/sites/sites_reader.h"

namespace vorpipe {
namespace {

using Json = nlohmann::ordered_json;

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
  table.system() = wgs84();
  if (top.is_object() && top.contains("crs")) {
    auto system = systemOfCrs(top["crs"]);
    if (!system) return system.error();
    table.system() = std::move(*system);
  }
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

Result<SiteTable> readGeoJsonSites(InputFile file, const ReadOptions& options) {
  TableBuilder table(file.name(), options);
  GeoJsonPoints points(table);
  JsonBytes bytes(file);
  Stream stream(bytes, points);
  const auto top = parseJson<Json>(bytes, stream);
  if (!top) return tl::unexpected(top.error());
  if (const auto problem = addTop(*top, stream.list(), points, table)) {
    return inputError(fmt::format("{}: {}", file.name(), *problem));
  }
  return table.finish();
}

Result<SiteTable> readGeoJsonLines(InputFile file, const ReadOptions& options) {
  LineReader lines(std::move(file));
  TableBuilder table(lines.name(), options);
  table.system() = wgs84();
  GeoJsonPoints points(table);
  auto read = eachJsonLine<Json>(lines, [&](const Json& value) { return points.add(value, ""); });
  if (!read) return tl::unexpected(std::move(read.error()));
  return table.finish();
}

}  // namespace vorpipe
