/// GeoPackages: SQLite databases with features, by OGC 12-128r17 (version 1.3).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "io/base/print.h"
#include "vorpipe.h"

struct sqlite3_stmt;

namespace vorpipe {

/// The codes of well-known binary.
enum class GeometryType : std::uint32_t {
  point = 1,
  line_string = 2,
  polygon = 3,
  multi_line_string = 5,
  multi_polygon = 6
};

/// A geometry under construction: types and counts are added in the order of well-known binary. The box is
/// that of all points so far.
class Wkb {
 public:
  /// Begins a geometry of `count` parts: polygons, rings or points.
  void begin(GeometryType type, std::size_t count) {
    beginType(type);
    append(static_cast<std::uint32_t>(count));
  }
  /// The whole geometry of a point.
  void addPoint(const Point& point) {
    beginType(GeometryType::point);
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

  [[nodiscard]] std::string_view bytes() const { return {bytes_.data(), bytes_.size()}; }
  [[nodiscard]] const Box& box() const { return box_; }

 private:
  void beginType(GeometryType type) {
    constexpr char little_endian = 1;
    bytes_.push_back(little_endian);
    append(static_cast<std::uint32_t>(type));
  }
  template <class Number>
  void append(Number number) {
    appendNumber<std::endian::little>(bytes_, number);
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr Box nowhere{infinity, infinity, -infinity, -infinity};

  Bytes bytes_;
  Box box_ = nowhere;
};

struct LayerField {
  std::string name;
  AttributeType type;  ///< json is written as text
};

/// A table of features: the key `fid`, from 1; the geometry `geom`; then the fields, whose names differ in
/// more than case.
struct Layer {
  std::string name;
  GeometryType geometry;  ///< of all features
  std::vector<LayerField> fields;
  CoordinateSystem system;
};

/// A feature being written: its geometry, and its values in the order of the fields.
class FeatureRow {
 public:
  FeatureRow(sqlite3_stmt* insertion, std::int32_t system) : insertion_(insertion), system_(system) {}

  void setGeometry(const Wkb& geometry);
  void add(std::int64_t value);
  void add(double value);
  void add(std::string_view value);  ///< UTF-8
  void addMissing();

  /// SQLite's code of the first failure.
  [[nodiscard]] int code() const { return code_; }
  /// Box of the geometry; none if there is no geometry.
  [[nodiscard]] const std::optional<Box>& box() const { return box_; }

 private:
  void note(int code);

  sqlite3_stmt* insertion_;
  std::int32_t system_;  ///< srs_id
  int column_ = 1;       ///< that of the geometry
  int code_ = 0;
  std::optional<Box> box_;
};

/// Adds a site's value to its row; NULL if it is missing.
void addValue(FeatureRow& row, const Attribute& attribute, std::size_t site);

/// Fills the row of the feature `index`; returns false to leave it out.
using FillRow = std::function<bool(std::size_t index, FeatureRow& row)>;

/// Writes a GeoPackage with one layer of the rows that `fill` fills for each index below `count`, and an
/// R-tree of their boxes. The same features give the same bytes: the required time of change is always
/// 2000-01-01. The whole file is in memory. Errors: SQLite refuses such a layer, with more than some 2,000
/// fields or a value of more than 1 GB (input); writing failed or memory ran out (device).
Result<void> writeGeoPackage(ByteSink& sink, const Layer& layer, std::size_t count, const FillRow& fill);

}  // namespace vorpipe
