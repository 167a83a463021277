#include <fmt/core.h>

#include <optional>
#include <string>
#include <utility>

#include "io/files/error.h"
#include "io/sites/geojson_points.h"
#include "io/sites/sites_reader.h"
#include "io/text/json_bytes.h"
#include "io/text/line_reader.h"
#include "io/text/number.h"

namespace vorpipe {
namespace {

using Json = nlohmann::ordered_json;
using Event = Json::parse_event_t;

/// Lists and objects in each other, which values of properties may be.
constexpr int deepest = 200;

/// Takes each member of the top object's list of features, or of geometries, as soon as it is parsed, so that
/// not all are kept.
class Stream {
 public:
  Stream(JsonBytes& bytes, GeoJsonPoints& points) : bytes_(bytes), points_(points) {}

  /// What the parser calls; false leaves the value out.
  bool operator()(int depth, Event event, const Json& value) {
    constexpr int of_members = 1, of_items = 2;
    if (depth > deepest) {
      bytes_.stop(bytes_.errorAt(0, fmt::format("stands in more than {} lists and objects", deepest)));
      return false;
    }
    if (depth == of_members) {
      if (event == Event::key) key_ = value.get<std::string>();
      const bool list = key_ == "features" || key_ == "geometries";
      if (event == Event::array_start && list) list_ = key_;
      if (event == Event::array_end) in_list_ = false;
      if (event == Event::array_start) in_list_ = list;
    }
    const bool ends = event == Event::object_end || event == Event::array_end || event == Event::value;
    if (depth != of_items || !in_list_ || !ends) return true;
    take(value);
    return false;
  }

  /// The name of the list that was taken; empty where there was none.
  [[nodiscard]] const std::string& list() const { return list_; }

 private:
  void take(const Json& item) {
    if (bytes_.stopped()) return;
    const auto problem = points_.add(item, fmt::format("{}[{}]", list_, count_++));
    if (problem) bytes_.stop(inputError(fmt::format("{}: {}", bytes_.name(), *problem)));
  }

  JsonBytes& bytes_;
  GeoJsonPoints& points_;
  std::string key_, list_;
  bool in_list_ = false;
  std::uint64_t count_ = 0;
};

/// The top object, of which `list` was taken already. What is wrong with it, if there is anything.
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

/// The bytes of a line of JSON; RFC 8142 has one before it that is none.
std::string_view withoutSeparator(std::string_view line) {
  line = trimmed(line);
  return line.starts_with('\x1E') ? trimmed(line.substr(1)) : line;
}

Result<void> addLine(const LineReader& lines, std::string_view line, GeoJsonPoints& points) {
  const std::string_view text = withoutSeparator(line);
  if (text.empty()) return {};
  JsonBytes bytes(lines.name(), text);
  bytes.setPlace(lines.number(), static_cast<std::size_t>(text.data() - line.data()));
  const auto limit = [&](int depth, Event, const Json&) {
    if (depth > deepest && !bytes.stopped()) {
      bytes.stop(bytes.errorAt(0, fmt::format("stands in more than {} lists and objects", deepest)));
    }
    return true;
  };
  const auto value = parseJson<Json>(bytes, limit);
  if (!value) return tl::unexpected(value.error());
  const auto problem = points.add(*value, "");
  if (problem) return inputError(fmt::format("{}:{}: {}", lines.name(), lines.number(), *problem));
  return {};
}

}  // namespace

Result<SiteTable> readGeoJsonSites(InputFile file, const ReadOptions& options) {
  TableBuilder table(file.name(), options);
  GeoJsonPoints points(table);
  JsonBytes bytes(file);
  Stream stream(bytes, points);
  const auto top = parseJson<Json>(
      bytes, [&stream](int depth, Event event, Json& value) { return stream(depth, event, value); });
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
  while (true) {
    const auto line = lines.next();
    if (!line) return tl::unexpected(line.error());
    if (!*line) return table.finish();
    if (auto added = addLine(lines, **line, points); !added) return tl::unexpected(std::move(added.error()));
  }
}

}  // namespace vorpipe
