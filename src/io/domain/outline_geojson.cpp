#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/domain/outline_reader.h"
#include "io/files/error.h"

namespace vorpipe {
namespace {

using nlohmann::json;

/// Collections in collections.
constexpr int deepest = 32;

/// What is wrong, and the path to it.
using Problem = std::optional<std::string>;

class GeoJson {
 public:
  explicit GeoJson(Outline& outline) : outline_(outline) {}

  Problem object(const json& value, const std::string& path, int depth = 0) {
    if (!value.is_object()) return wrong(path, fmt::format("a {}, not an object", value.type_name()));
    const auto type = value.find("type");
    if (type == value.end() || !type->is_string()) return wrong(path, "has no \"type\" that is a string");
    const auto& name = type->get_ref<const std::string&>();
    if (depth > deepest) return wrong(path, fmt::format("stands in more than {} collections", deepest));
    if (name == "Polygon")
      return member(value, path, "coordinates", [&](auto&&... at) { return polygon(at...); });
    if (name == "MultiPolygon") {
      return each(value, path, "coordinates", [&](auto&&... at) { return polygon(at...); });
    }
    const auto inner = [&](const json& at, const std::string& its_path) {
      return object(at, its_path, depth + 1);
    };
    if (name == "Feature") {
      // A feature may have no place, as the cells that are empty.
      const auto geometry = value.find("geometry");
      if (geometry != value.end() && geometry->is_null()) return {};
      return member(value, path, "geometry", inner);
    }
    if (name == "FeatureCollection") return each(value, path, "features", inner);
    if (name == "GeometryCollection") return each(value, path, "geometries", inner);
    return wrong(path, fmt::format("is a {}; a Polygon or MultiPolygon is needed", vorpipe::quoted(name)));
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

/// Line and column of a byte, from 1.
std::string placeOf(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t last_end = before.rfind('\n');
  const std::size_t column = 1 + (last_end == std::string_view::npos ? byte : byte - last_end - 1);
  return fmt::format("{}:{}", line, column);
}

/// What a text is that the parser refuses, and from which byte on. It takes no notice of what is right.
class Refusal {
 public:
  explicit Refusal(std::string_view text) { json::sax_parse(text, this); }

  [[nodiscard]] std::size_t byte() const { return byte_; }
  [[nodiscard]] std::string_view what() const { return what_; }

  // What the parser calls; false stops it.
  using Text = json::string_t;
  static bool null() { return true; }
  static bool boolean(bool) { return true; }
  static bool number_integer(json::number_integer_t) { return true; }
  static bool number_unsigned(json::number_unsigned_t) { return true; }
  static bool number_float(json::number_float_t, const Text&) { return true; }
  static bool string(const Text&) { return true; }
  static bool binary(const json::binary_t&) { return true; }
  static bool start_object(std::size_t) { return true; }
  static bool key(const Text&) { return true; }
  static bool end_object() { return true; }
  static bool start_array(std::size_t) { return true; }
  static bool end_array() { return true; }
  /// `end` is the number of bytes that were read, `last` the token at their end.
  bool parse_error(std::size_t end, const std::string& last, const json::exception& error) {
    const bool number = dynamic_cast<const json::out_of_range*>(&error) != nullptr;
    what_ = number ? "the number is too large for a double" : "is no JSON from here on";
    byte_ = end - std::min(end, number ? last.size() : 1);
    return false;
  }

 private:
  std::size_t byte_ = 0;
  std::string_view what_;
};

}  // namespace

Result<Outline> readGeoJsonOutline(const std::string& name, std::string_view text) {
  const json value = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (value.is_discarded()) {
    const Refusal refusal(text);
    return inputError(fmt::format("{}:{}: {}", name, placeOf(text, refusal.byte()), refusal.what()));
  }
  Outline outline;
  if (const auto problem = GeoJson(outline).object(value, {})) {
    return inputError(fmt::format("{}: {}", name, *problem));
  }
  return outline;
}

}  // namespace vorpipe
