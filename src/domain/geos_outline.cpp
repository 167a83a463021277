#include "domain/geos_outline.h"

#include <span>
#include <utility>
#include <vector>

namespace vorpipe::core {
namespace {

/// Adds a ring without its last point, which equals the first.
bool addRing(const Geos& geos, const GEOSGeometry* ring, Outline& outline) {
  const GEOSCoordSequence* sequence = ring != nullptr ? GEOSGeom_getCoordSeq_r(geos.handle(), ring) : nullptr;
  unsigned count = 0;
  if (sequence == nullptr || GEOSCoordSeq_getSize_r(geos.handle(), sequence, &count) != 1 || count == 0) {
    return false;
  }
  const std::size_t begin = outline.points.size();
  outline.points.resize(begin + count);
  if (GEOSCoordSeq_copyToBuffer_r(geos.handle(), sequence, &outline.points[begin].x, /*hasZ=*/0,
                                  /*hasM=*/0) != 1) {
    return false;
  }
  outline.points.pop_back();
  outline.ring_offsets.push_back(outline.points.size());
  return true;
}

bool addPolygon(const Geos& geos, const GEOSGeometry* polygon, Outline& outline) {
  if (GEOSisEmpty_r(geos.handle(), polygon) == 1) return true;
  if (!addRing(geos, GEOSGetExteriorRing_r(geos.handle(), polygon), outline)) return false;
  const int holes = GEOSGetNumInteriorRings_r(geos.handle(), polygon);
  for (int k = 0; k < holes; ++k) {
    if (!addRing(geos, GEOSGetInteriorRingN_r(geos.handle(), polygon, k), outline)) return false;
  }
  outline.polygon_offsets.push_back(outline.ring_offsets.size() - 1);
  return true;
}

}  // namespace

GeosGeometry polygonOf(const Geos& geos, const Outline& outline, std::size_t polygon) {
  std::vector<GeosGeometry> rings;
  for (auto r = outline.polygon_offsets[polygon]; r < outline.polygon_offsets[polygon + 1]; ++r) {
    const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
    rings.push_back(geosRing(geos, std::span(outline.points).subspan(begin, end - begin)));
  }
  return geosPolygon(geos, std::move(rings));
}

GeosGeometry geometryOf(const Geos& geos, const Outline& outline) {
  std::vector<GeosGeometry> polygons;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    polygons.push_back(polygonOf(geos, outline, p));
    if (!polygons.back()) return owned(geos, nullptr);
  }
  const auto count = static_cast<unsigned>(polygons.size());
  auto taken = released(polygons);
  return owned(geos, GEOSGeom_createCollection_r(geos.handle(), GEOS_MULTIPOLYGON, taken.data(), count));
}

bool addPolygons(const Geos& geos, const GEOSGeometry* geometry, Outline& outline) {
  if (outline.ring_offsets.empty()) outline.ring_offsets = outline.polygon_offsets = {0};
  if (geometry == nullptr) return false;
  const int kind = GEOSGeomTypeId_r(geos.handle(), geometry);
  if (kind == GEOS_POLYGON) return addPolygon(geos, geometry, outline);
  if (kind != GEOS_MULTIPOLYGON && kind != GEOS_GEOMETRYCOLLECTION) return true;
  const int count = GEOSGetNumGeometries_r(geos.handle(), geometry);
  for (int k = 0; k < count; ++k) {
    if (!addPolygons(geos, GEOSGetGeometryN_r(geos.handle(), geometry, k), outline)) return false;
  }
  return true;
}

}  // namespace vorpipe::core
