#include "io/base/geometry_bytes.h"

#include <fmt/core.h>

namespace vorpipe {

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

std::string nameOfWkbType(std::uint32_t type) {
  constexpr std::array<std::string_view, 8> names = {
      "Geometry",   "Point",           "LineString",   "Polygon",
      "MultiPoint", "MultiLineString", "MultiPolygon", "GeometryCollection"};
  return type < names.size() ? std::string(names[type]) : fmt::format("geometry of type {}", type);
}

Point takeWkbPosition(ByteReader& reader, const WkbType& type) {
  const auto x = reader.take<double>(), y = reader.take<double>();
  for (std::size_t k = 2; k < type.numbers; ++k) reader.take<double>();
  return {x, y};
}

tl::expected<ByteReader, std::string> geometryIn(std::string_view bytes) {
  constexpr std::array<std::size_t, 5> envelope_sizes = {0, 32, 48, 48, 64};
  constexpr std::size_t magic = 3, system = 4;
  if (!bytes.starts_with("GP"))
    return tl::unexpected(std::string("its geometry does not begin as a GeoPackage's do"));
  ByteReader reader(bytes);
  reader.skip(magic);
  const auto flags = static_cast<unsigned char>(reader.take<char>());
  const std::size_t envelope = flags >> 1 & 7;
  if (reader.failed() || envelope >= envelope_sizes.size())
    return tl::unexpected(std::string("the header of its geometry is damaged"));
  reader.skip(system + envelope_sizes[envelope]);
  if (reader.failed()) return tl::unexpected(damagedGeometry().error());
  return reader;
}

}  // namespace vorpipe
