/// The tables that every GeoPackage has.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/base/coordinate_system.h"
#include "io/base/geopackage.h"

namespace vorpipe {

/// A row of gpkg_spatial_ref_sys.
struct SpatialReference {
  std::string name;
  std::int32_t id;  ///< srs_id
  std::string organization;
  std::int64_t code;
  std::string definition;
};

/// Returns the row of a coordinate system: an unknown one is an undefined plane, -1; degrees of unknown
/// origin are 0.
SpatialReference referenceOf(const CoordinateSystem& system);

/// SQL that creates the tables of GeoPackages, with the rows that each must have and that of `reference`.
std::string geoPackageTables(const SpatialReference& reference);

/// SQL that creates a layer's own table and registers it.
std::string layerTable(const Layer& layer, const SpatialReference& reference);

/// SQL that inserts a feature: its geometry is parameter 1, and its fields follow.
std::string featureInsertion(const Layer& layer);

/// SQL that creates a layer's R-tree without triggers; SQL that keeps it up to date from then on.
std::string treeTable(const Layer& layer);
std::string treeTriggers(const Layer& layer);

/// SQL that stores the box of all features.
std::string contentsBox(const Layer& layer, const Box& box);

}  // namespace vorpipe
