/// Geometries as well-known binary.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "io/base/byte_order.h"
#include "io/base/print.h"
#include "vorpipe.h"

namespace vorpipe {

/// The codes of well-known binary.
enum class GeometryType : std::uint32_t { point = 1, line_string = 2, polygon = 3, multi_polygon = 6 };

/// A geometry under construction: types and counts are added in the order of well-known binary. The box is
/// that of all points so far.
class Wkb {
 public:
  /// Begins a geometry of `count` parts: polygons, rings or points.
  void begin(GeometryType type, std::size_t count) {
    constexpr char little_endian = 1;
    bytes_.push_back(little_endian);
    append(static_cast<std::uint32_t>(type));
    append(static_cast<std::uint32_t>(count));
  }
  /// The whole geometry of a point.
  void addPoint(const Point& point) {
    constexpr char little_endian = 1;
    bytes_.push_back(little_endian);
    append(static_cast<std::uint32_t>(GeometryType::point));
    add(point);
  }
  /// Begins a ring of `count` points.
  void beginRing(std::size_t count) { append(static_cast<std::uint32_t>(count)); }
  void add(const Point& point) {
    append(point.x);
    append(point.y);
    box_ = {std::min(box_.xmin, point.x), std::min(box_.ymin, point.y), std::max(box_.xmax, point.x),
            std::max(box_.ymax, point.y)};
  }
  void clear() {
    bytes_.clear();
    box_ = nowhere;
  }

  [[nodiscard]] bool empty() const { return bytes_.size() == 0; }
  [[nodiscard]] std::string_view bytes() const { return {bytes_.data(), bytes_.size()}; }
  [[nodiscard]] const Box& box() const { return box_; }

 private:
  template <class Number>
  void append(Number number) {
    appendNumber<std::endian::little>(bytes_, number);
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr Box nowhere{infinity, infinity, -infinity, -infinity};

  Bytes bytes_;
  Box box_ = nowhere;
};

}  // namespace vorpipe
