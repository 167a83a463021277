#include "io/cells/hole_triangles.h"

#include <utility>

#include "base/geos.h"

namespace vorpipe {
namespace {

using Triangles = std::vector<std::array<Point, 3>>;

std::array<Point, 3> cornersOf(GEOSContextHandle_t context, const GEOSGeometry* triangle) {
  const auto* const sequence = GEOSGeom_getCoordSeq_r(context, GEOSGetExteriorRing_r(context, triangle));
  std::array<Point, 3> corners{};
  for (unsigned k = 0; k < corners.size(); ++k) {
    GEOSCoordSeq_getXY_r(context, sequence, k, &corners[k].x, &corners[k].y);
  }
  char counter_clockwise = 1;
  GEOSCoordSeq_isCCW_r(context, sequence, &counter_clockwise);
  if (counter_clockwise == 0) std::swap(corners[1], corners[2]);
  return corners;
}

}  // namespace

std::optional<Triangles> trianglesOf(const Diagram& diagram, std::span<const Ring> piece) {
  const Geos geos;
  std::vector<GeosGeometry> rings;
  for (const Ring& ring : piece) rings.push_back(geosRing(geos, verticesOf(diagram, ring)));
  const GeosGeometry polygon = geosPolygon(geos, std::move(rings));
  if (!polygon) return std::nullopt;
  const GeosGeometry found =
      owned(geos, GEOSConstrainedDelaunayTriangulation_r(geos.handle(), polygon.get()));
  if (!found) return std::nullopt;
  const int count = GEOSGetNumGeometries_r(geos.handle(), found.get());
  Triangles triangles;
  for (int k = 0; k < count; ++k) {
    triangles.push_back(cornersOf(geos.handle(), GEOSGetGeometryN_r(geos.handle(), found.get(), k)));
  }
  return triangles;
}

}  // namespace vorpipe
