#include "io/base/geometry_polygons.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "base/try.h"
#include "io/base/geojson_nesting.h"
#include "io/base/geometry_bytes.h"

namespace vorpipe {
namespace {

GeometryTaken takeRing(ByteReader& reader, const WkbType& type, std::vector<Point>& ring) {
  const auto count = reader.take<std::uint32_t>();
  // Counts in damaged geometries may be anything: the end of the bytes ends the loop.
  for (std::uint32_t k = 0; k < count && !reader.failed(); ++k) {
    const auto [x, y] = takeWkbPosition(reader, type);
    if (!std::isfinite(x) || !std::isfinite(y))
      return wrongGeometry(fmt::format("its position {}, {} is not finite", x, y));
    ring.push_back({x, y});
  }
  return reader.failed() ? damagedGeometry() : GeometryTaken();
}

GeometryTaken takePolygon(ByteReader& reader, const WkbType& type, std::vector<PolygonRings>& polygons) {
  const auto count = reader.take<std::uint32_t>();
  PolygonRings rings;
  for (std::uint32_t k = 0; k < count; ++k) {
    VORPIPE_TRY(takeRing(reader, type, rings.emplace_back()));
  }
  if (reader.failed()) return damagedGeometry();
  if (!rings.empty()) polygons.push_back(std::move(rings));
  return {};
}

GeometryTaken takeWkb(ByteReader& reader, std::vector<PolygonRings>& polygons, int depth) {
  constexpr std::uint32_t polygon = 3, multi_polygon = 6, collection = 7;
  const WkbType type = takeWkbType(reader);
  if (reader.failed()) return damagedGeometry();
  if (type.type == polygon) return takePolygon(reader, type, polygons);
  if (type.type != multi_polygon && type.type != collection)
    return wrongGeometry(fmt::format("a {} where a Polygon is needed", nameOfWkbType(type.type)));
  if (depth > most_nested_collections)
    return wrongGeometry(fmt::format("stands in more than {} collections", most_nested_collections));
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count; ++k) {
    VORPIPE_TRY(takeWkb(reader, polygons, depth + 1));
  }
  return reader.failed() ? damagedGeometry() : GeometryTaken();
}

}  // namespace

tl::expected<void, std::string> takeGeometryPolygons(std::string_view bytes,
                                                     std::vector<PolygonRings>& polygons) {
  auto reader = geometryIn(bytes);
  if (!reader) return wrongGeometry(std::move(reader.error()));
  return takeWkb(*reader, polygons, 0);
}

}  // namespace vorpipe
