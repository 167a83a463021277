#include <fmt/core.h>

#include <cstdint>
#include <utility>

#include "base/try.h"
#include "io/base/error.h"
#include "io/base/feature_layer.h"
#include "io/base/geometry_polygons.h"
#include "io/base/quoted.h"
#include "io/sites/outline_reader.h"

namespace vorpipe {
namespace {

/// Adds the polygons of the current row. The error states what is wrong with them.
tl::expected<void, std::string> addRow(const FeatureLayer& layer, Outline& outline) {
  const auto geometry = layer.geometry();
  if (!geometry) return {};
  std::vector<PolygonRings> polygons;
  VORPIPE_TRY(takeGeometryPolygons(*geometry, polygons));
  for (PolygonRings& rings : polygons) {
    for (auto& ring : rings) {
      VORPIPE_TRY(addRing(std::move(ring), outline));
    }
    endPolygon(outline);
  }
  return {};
}

}  // namespace

Result<OutlineFile> readGeoPackageOutline(const std::string& path, const std::string& name) {
  auto layer = FeatureLayer::open(path, name, LayerOf::polygons);
  if (!layer) return tl::unexpected(layer.error());
  OutlineFile read{{}, layer->system()};
  for (std::uint64_t row = 1;; ++row) {
    const auto more = layer->next();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return read;
    if (const auto added = addRow(*layer, read.outline); !added) {
      return inputError(
          fmt::format("{}: layer {}, row {}: {}", path, printable(layer->name()), row, added.error()));
    }
  }
}

}  // namespace vorpipe
