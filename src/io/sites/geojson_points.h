/// Takes sites from parsed GeoJSON, one feature or geometry after the other.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/coordinate_system.h"
#include "io/sites/table_builder.h"
#include "io/sites/weight_name.h"

namespace vorpipe {

/// What is wrong, after the path to it.
using GeoJsonProblem = std::optional<std::string>;

class GeoJsonPoints {
 public:
  explicit GeoJsonPoints(TableBuilder& table) : table_(table) {}

  /// Adds the sites of a Feature, or of a geometry: a Point, a MultiPoint, or a GeometryCollection of them.
  /// `path` is its path in the file.
  GeoJsonProblem add(const nlohmann::ordered_json& object, const std::string& path);

 private:
  using Json = nlohmann::ordered_json;

  GeoJsonProblem addFeature(const Json& feature, const std::string& path);
  GeoJsonProblem takeProperties(const Json& feature, const std::string& path);
  GeoJsonProblem takeWeight(const std::string& name, WeightKind kind, const Json& value,
                            const std::string& path);
  GeoJsonProblem takeGeometry(const Json& geometry, const std::string& path, int depth);
  GeoJsonProblem takePosition(const Json& position, const std::string& path);
  void setAttribute(const std::string& name, const Json& value);
  GeoJsonProblem endRow(const std::string& path);

  TableBuilder& table_;
  std::vector<Point> points_;     ///< of the feature
  std::optional<double> weight_;  ///< of the feature
  std::string weight_name_;       ///< of the feature; empty if it has none
  bool weight_noted_ = false;
};

/// Returns the system that a member "crs" names, as in GeoJSON of 2008; WGS 84 if it is null.
tl::expected<CoordinateSystem, std::string> systemOfCrs(const nlohmann::ordered_json& crs);

}  // namespace vorpipe
