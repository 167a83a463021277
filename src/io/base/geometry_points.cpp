#include "io/base/geometry_points.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "base/try.h"
#include "io/base/geometry_bytes.h"

namespace vorpipe {
namespace {

GeometryTaken takePosition(ByteReader& reader, const WkbType& type, std::vector<Point>& points,
                           bool& others) {
  const auto [x, y] = takeWkbPosition(reader, type);
  if (reader.failed()) return damagedGeometry();
  // The coordinates of an empty point are NaN.
  if (std::isnan(x) && std::isnan(y)) return {};
  if (!std::isfinite(x) || !std::isfinite(y))
    return wrongGeometry(fmt::format("its place {}, {} is not finite", x, y));
  others = others || type.numbers > 2;
  points.push_back({x, y});
  return {};
}

GeometryTaken takeWkb(ByteReader& reader, std::vector<Point>& points, bool& others) {
  constexpr std::uint32_t point = 1, multi_point = 4;
  const WkbType type = takeWkbType(reader);
  if (reader.failed()) return damagedGeometry();
  if (type.type == point) return takePosition(reader, type, points, others);
  if (type.type != multi_point)
    return wrongGeometry(fmt::format("a {} where a Point is needed", nameOfWkbType(type.type)));
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count; ++k) {
    const WkbType its = takeWkbType(reader);
    if (reader.failed()) return damagedGeometry();
    if (its.type != point) return wrongGeometry(fmt::format("a {} in a MultiPoint", nameOfWkbType(its.type)));
    VORPIPE_TRY(takePosition(reader, its, points, others));
  }
  return reader.failed() ? damagedGeometry() : GeometryTaken();
}

}  // namespace

tl::expected<void, std::string> takeGeometryPoints(std::string_view bytes, std::vector<Point>& points,
                                                   bool& others) {
  auto reader = geometryIn(bytes);
  if (!reader) return wrongGeometry(std::move(reader.error()));
  return takeWkb(*reader, points, others);
}

}  // namespace vorpipe
