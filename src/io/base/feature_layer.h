/// A layer of a GeoPackage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/base/attribute.h"
#include "io/base/coordinate_system.h"
#include "io/base/sqlite.h"
#include "vorpipe.h"

namespace vorpipe {

/// Geometry that a layer must hold.
enum class LayerOf : std::uint8_t { points, polygons };

struct LayerColumn {
  std::string name;
  AttributeType type;  ///< as declared
};

/// Rows of a layer, one after the other. Errors begin with the file's name.
class FeatureLayer {
 public:
  /// Opens a file for reading. `name` is the layer's; empty: the only one of that kind. Errors: the file is
  /// no GeoPackage, or has no such layer or several (input); reading failed, memory ran out (device).
  /// Messages name `path`; `converted` is what is opened in its place, if it is not empty.
  static Result<FeatureLayer> open(const std::string& path, const std::string& name, LayerOf kind,
                                   const std::string& converted = {});

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const CoordinateSystem& system() const { return system_; }
  /// All columns except the geometry and binary ones.
  [[nodiscard]] const std::vector<LayerColumn>& columns() const { return columns_; }
  /// Columns that hold bytes.
  [[nodiscard]] const std::vector<std::string>& binary() const { return binary_; }

  /// Advances to the next row; false after the last. Errors: the file is damaged (input), reading failed
  /// (device).
  Result<bool> next();

  /// Returns the geometry's bytes in the current row; none if it is missing.
  [[nodiscard]] std::optional<std::string_view> geometry() const;
  /// Returns a value of the current row, in its column's type if it fits, else as SQLite stored it. None if
  /// it is missing or binary. Text need not be UTF-8.
  [[nodiscard]] std::optional<std::pair<AttributeType, std::string>> value(std::size_t column) const;

 private:
  explicit FeatureLayer(std::string path) : path_(std::move(path)) {}
  [[nodiscard]] tl::unexpected<Error> failed(int code) const;
  Result<void> openDatabase(const std::string& path);
  Result<Statement> prepare(const std::string& sql, std::string_view parameter) const;
  Result<bool> step(const Statement& statement) const;
  template <class Use>
  Result<void> eachRow(const std::string& sql, std::string_view parameter, const Use& use) const;
  Result<void> chooseLayer(const std::string& name, LayerOf kind);
  Result<void> findColumns();
  Result<void> findSystem();
  Result<void> select();

  std::string path_;
  std::unique_ptr<QueryLimits> limits_ = std::make_unique<QueryLimits>();  ///< used by SQLite's callbacks
  Database database_;
  std::string name_, geometry_column_;
  std::int64_t system_id_ = 0;
  CoordinateSystem system_{};
  std::vector<LayerColumn> columns_;
  std::vector<std::string> binary_;
  Statement rows_;
};

}  // namespace vorpipe
