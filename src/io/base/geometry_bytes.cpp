#include "io/base/geometry_bytes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/try.h"

namespace vorpipe {
namespace {

tl::unexpected<std::string> wrongGeometry(std::string what) { return tl::unexpected(std::move(what)); }

/// Takes numbers of either byte order off the front of bytes. Past their end it returns 0, and failed() is
/// true.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  void setOrder(bool little) { swapped_ = little != (std::endian::native == std::endian::little); }
  [[nodiscard]] bool failed() const { return failed_; }
  /// Success, unless bytes were missing.
  [[nodiscard]] GeometryTaken end() const {
    return failed_ ? wrongGeometry("its geometry is damaged: it ends too early") : GeometryTaken();
  }
  void skip(std::size_t count) {
    failed_ = failed_ || count > rest_.size();
    rest_.remove_prefix(std::min(count, rest_.size()));
  }

  template <class Number>
  Number take() {
    std::array<char, sizeof(Number)> bytes{};
    if (rest_.size() < bytes.size()) {
      failed_ = true;
      return Number{};
    }
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    if (swapped_) std::ranges::reverse(bytes);
    return std::bit_cast<Number>(bytes);
  }

 private:
  std::string_view rest_;
  bool swapped_ = false, failed_ = false;
};

/// The type of a geometry, and how many numbers a position has.
struct WkbType {
  std::uint32_t type = 0;
  std::size_t numbers = 2;
};

/// Takes the byte order and type at the start of a well-known binary geometry.
WkbType takeWkbType(ByteReader& reader) {
  constexpr std::uint32_t has_z = 0x80000000, has_m = 0x40000000, has_system = 0x20000000, dimensions = 1000;
  reader.setOrder(reader.take<char>() == 1);
  const auto code = reader.take<std::uint32_t>();
  if ((code & has_system) != 0) reader.skip(sizeof(std::int32_t));
  const std::uint32_t plain = code & ~(has_z | has_m | has_system);
  WkbType type{plain % dimensions};
  const std::uint32_t iso = plain / dimensions;  // 1: Z, 2: M, 3: both
  type.numbers += (iso == 3 ? 2u : iso > 0 ? 1u : 0u);
  type.numbers += ((code & has_z) != 0 ? 1u : 0u) + ((code & has_m) != 0 ? 1u : 0u);
  return type;
}

/// Returns the type's name for messages: "Polygon".
std::string nameOfWkbType(std::uint32_t type) {
  constexpr std::array<std::string_view, 8> names = {
      "Geometry",   "Point",           "LineString",   "Polygon",
      "MultiPoint", "MultiLineString", "MultiPolygon", "GeometryCollection"};
  return type < names.size() ? std::string(names[type]) : fmt::format("geometry of type {}", type);
}

/// Takes x and y, and skips a position's other numbers.
Point takeWkbPosition(ByteReader& reader, const WkbType& type) {
  const auto x = reader.take<double>(), y = reader.take<double>();
  for (std::size_t k = 2; k < type.numbers; ++k) reader.take<double>();
  return {x, y};
}

/// Takes the header of a geometry by clause 2.1.3 of the standard.
tl::expected<ByteReader, std::string> geometryIn(std::string_view bytes) {
  constexpr std::array<std::size_t, 5> envelope_sizes = {0, 32, 48, 48, 64};
  constexpr std::size_t magic = 3, system = 4;
  if (!bytes.starts_with("GP")) return wrongGeometry("its geometry does not begin as a GeoPackage's do");
  ByteReader reader(bytes);
  reader.skip(magic);
  const auto flags = static_cast<unsigned char>(reader.take<char>());
  const std::size_t envelope = flags >> 1 & 7;
  if (reader.failed() || envelope >= envelope_sizes.size())
    return wrongGeometry("the header of its geometry is damaged");
  reader.skip(system + envelope_sizes[envelope]);
  return reader.end().map([&] { return reader; });
}

GeometryTaken takePosition(ByteReader& reader, const WkbType& type, std::vector<Point>& points,
                           bool& others) {
  const auto [x, y] = takeWkbPosition(reader, type);
  VORPIPE_TRY(reader.end());
  // The coordinates of an empty point are NaN.
  if (std::isnan(x) && std::isnan(y)) return {};
  if (!std::isfinite(x) || !std::isfinite(y))
    return wrongGeometry(fmt::format("its place {}, {} is not finite", x, y));
  others = others || type.numbers > 2;
  points.push_back({x, y});
  return {};
}

GeometryTaken takePoints(ByteReader& reader, std::vector<Point>& points, bool& others) {
  constexpr std::uint32_t point = 1, multi_point = 4;
  const WkbType type = takeWkbType(reader);
  VORPIPE_TRY(reader.end());
  if (type.type == point) return takePosition(reader, type, points, others);
  if (type.type != multi_point)
    return wrongGeometry(fmt::format("a {} where a Point is needed", nameOfWkbType(type.type)));
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count; ++k) {
    const WkbType its = takeWkbType(reader);
    VORPIPE_TRY(reader.end());
    if (its.type != point) return wrongGeometry(fmt::format("a {} in a MultiPoint", nameOfWkbType(its.type)));
    VORPIPE_TRY(takePosition(reader, its, points, others));
  }
  return reader.end();
}

GeometryTaken takeRing(ByteReader& reader, const WkbType& type, std::vector<Point>& ring) {
  const auto count = reader.take<std::uint32_t>();
  // Counts in damaged geometries may be anything: the end of the bytes ends the loop.
  for (std::uint32_t k = 0; k < count && !reader.failed(); ++k) {
    const auto [x, y] = takeWkbPosition(reader, type);
    if (!std::isfinite(x) || !std::isfinite(y))
      return wrongGeometry(fmt::format("its position {}, {} is not finite", x, y));
    ring.push_back({x, y});
  }
  return reader.end();
}

GeometryTaken takePolygon(ByteReader& reader, const WkbType& type, std::vector<PolygonRings>& polygons) {
  const auto count = reader.take<std::uint32_t>();
  PolygonRings rings;
  for (std::uint32_t k = 0; k < count; ++k) {
    VORPIPE_TRY(takeRing(reader, type, rings.emplace_back()));
  }
  VORPIPE_TRY(reader.end());
  if (!rings.empty()) polygons.push_back(std::move(rings));
  return {};
}

GeometryTaken takePolygons(ByteReader& reader, std::vector<PolygonRings>& polygons, int depth) {
  constexpr std::uint32_t polygon = 3, multi_polygon = 6, collection = 7;
  const WkbType type = takeWkbType(reader);
  VORPIPE_TRY(reader.end());
  if (type.type == polygon) return takePolygon(reader, type, polygons);
  if (type.type != multi_polygon && type.type != collection)
    return wrongGeometry(fmt::format("a {} where a Polygon is needed", nameOfWkbType(type.type)));
  if (depth > most_nested_collections)
    return wrongGeometry(fmt::format("stands in more than {} collections", most_nested_collections));
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count; ++k) {
    VORPIPE_TRY(takePolygons(reader, polygons, depth + 1));
  }
  return reader.end();
}

}  // namespace

GeometryTaken takeGeometryPoints(std::string_view bytes, std::vector<Point>& points, bool& others) {
  return geometryIn(bytes).and_then([&](ByteReader reader) { return takePoints(reader, points, others); });
}

GeometryTaken takeGeometryPolygons(std::string_view bytes, std::vector<PolygonRings>& polygons) {
  return geometryIn(bytes).and_then([&](ByteReader reader) { return takePolygons(reader, polygons, 0); });
}

}  // namespace vorpipe
