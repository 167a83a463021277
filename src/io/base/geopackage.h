/// GeoPackages: SQLite databases with features, by OGC 12-128r17 (version 1.3).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/byte_sink.h"
#include "io/base/coordinate_system.h"
#include "io/base/wkb.h"
#include "vorpipe.h"

struct sqlite3_stmt;

namespace vorpipe {

enum class FieldType : std::uint8_t { integer, real, boolean, text };

struct LayerField {
  std::string name;
  FieldType type;
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
  int next() { return ++column_; }

  sqlite3_stmt* insertion_;
  std::int32_t system_;  ///< srs_id
  int column_ = 1;       ///< that of the geometry
  int code_ = 0;
  std::optional<Box> box_;
};

/// Fills the row of the feature `index`; returns false to leave it out.
using FillRow = std::function<bool(std::size_t index, FeatureRow& row)>;

/// Writes a GeoPackage with one layer of the rows that `fill` fills for each index below `count`, and an
/// R-tree of their boxes. The same features give the same bytes: the required time of change is always
/// 2000-01-01. The whole file is in memory. Errors: SQLite refuses such a layer, with more than some 2,000
/// fields or a value of more than 1 GB (input); writing failed or memory ran out (device).
Result<void> writeGeoPackage(ByteSink& sink, const Layer& layer, std::size_t count, const FillRow& fill);

}  // namespace vorpipe
