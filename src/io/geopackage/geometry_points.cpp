#include "io/geopackage/geometry_points.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

namespace vorpipe {
namespace {

using Taken = tl::expected<void, std::string>;

tl::unexpected<std::string> wrong(std::string what) { return tl::unexpected(std::move(what)); }
tl::unexpected<std::string> damaged() { return wrong("its geometry is damaged: it ends too early"); }

/// Numbers of either byte order off the front of bytes; 0 where they end, after which failed() is true.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  void setOrder(bool little) { swapped_ = little != (std::endian::native == std::endian::little); }
  [[nodiscard]] bool failed() const { return failed_; }
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

WkbType takeType(ByteReader& reader) {
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

std::string nameOf(std::uint32_t type) {
  constexpr std::array<std::string_view, 8> names = {
      "Geometry",   "Point",           "LineString",   "Polygon",
      "MultiPoint", "MultiLineString", "MultiPolygon", "GeometryCollection"};
  return type < names.size() ? std::string(names[type]) : fmt::format("geometry of type {}", type);
}

Taken takePosition(ByteReader& reader, const WkbType& type, std::vector<Point>& points, bool& others) {
  const auto x = reader.take<double>(), y = reader.take<double>();
  for (std::size_t k = 2; k < type.numbers; ++k) reader.take<double>();
  if (reader.failed()) return damaged();
  // An empty point is one of no numbers.
  if (std::isnan(x) && std::isnan(y)) return {};
  if (!std::isfinite(x) || !std::isfinite(y))
    return wrong(fmt::format("its place {}, {} is not finite", x, y));
  others = others || type.numbers > 2;
  points.push_back({x, y});
  return {};
}

Taken takeWkb(ByteReader& reader, std::vector<Point>& points, bool& others) {
  constexpr std::uint32_t point = 1, multi_point = 4;
  const WkbType type = takeType(reader);
  if (reader.failed()) return damaged();
  if (type.type == point) return takePosition(reader, type, points, others);
  if (type.type != multi_point) return wrong(fmt::format("a {} where a Point is needed", nameOf(type.type)));
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count; ++k) {
    const WkbType its = takeType(reader);
    if (reader.failed()) return damaged();
    if (its.type != point) return wrong(fmt::format("a {} in a MultiPoint", nameOf(its.type)));
    if (auto taken = takePosition(reader, its, points, others); !taken) return taken;
  }
  return reader.failed() ? Taken(damaged()) : Taken();
}

}  // namespace

Taken takeGeometryPoints(std::string_view bytes, std::vector<Point>& points, bool& others) {
  constexpr std::array<std::size_t, 5> envelope_sizes = {0, 32, 48, 48, 64};
  constexpr std::size_t magic = 3, system = 4;
  if (!bytes.starts_with("GP")) return wrong("its geometry does not begin as a GeoPackage's do");
  ByteReader reader(bytes);
  reader.skip(magic);
  const auto flags = static_cast<unsigned char>(reader.take<char>());
  const std::size_t envelope = flags >> 1 & 7;
  if (reader.failed() || envelope >= envelope_sizes.size())
    return wrong("the header of its geometry is damaged");
  reader.skip(system + envelope_sizes[envelope]);
  if (reader.failed()) return damaged();
  return takeWkb(reader, points, others);
}

}  // namespace vorpipe
