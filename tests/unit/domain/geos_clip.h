/// GEOS as the judge of cells that are clipped to an outline.
#pragma once

#include <geos_c.h>

#include <span>
#include <string>
#include <vector>

#include "unit/fixtures/outlines.h"
#include "vorpipe.h"

namespace vorpipe::test {

/// Why the polygons of a cell are not valid; empty where they are.
inline std::string whyInvalid(const Diagram& diagram, std::size_t cell) {
  GEOSContextHandle_t geos = GEOS_init_r();
  const auto bounds = ringBounds(diagram, cell);
  std::vector<GEOSGeometry*> polygons, rings;
  const auto closePolygon = [&] {
    if (rings.empty()) return;
    polygons.push_back(
        GEOSGeom_createPolygon_r(geos, rings[0], rings.data() + 1, static_cast<unsigned>(rings.size() - 1)));
    rings.clear();
  };
  for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
    const auto ring = std::span(diagram.vertices).subspan(bounds[r], bounds[r + 1] - bounds[r]);
    if (ringArea(ring) > 0) closePolygon();
    std::vector<Point> closed(ring.begin(), ring.end());
    closed.push_back(closed[0]);
    rings.push_back(GEOSGeom_createLinearRing_r(
        geos, GEOSCoordSeq_copyFromBuffer_r(geos, &closed[0].x, static_cast<unsigned>(closed.size()), 0, 0)));
  }
  closePolygon();
  GEOSGeometry* all = GEOSGeom_createCollection_r(geos, GEOS_MULTIPOLYGON, polygons.data(),
                                                  static_cast<unsigned>(polygons.size()));
  char* reason = GEOSisValidReason_r(geos, all);
  const std::string why = reason;
  GEOSFree_r(geos, reason);
  GEOSGeom_destroy_r(geos, all);
  GEOS_finish_r(geos);
  return why == "Valid Geometry" ? "" : why;
}

/// Another way to the same areas: GEOS, cell by cell.
class GeosClip {
 public:
  explicit GeosClip(const Outline& outline) : geos_(GEOS_init_r()) {
    std::vector<GEOSGeometry*> polygons;
    for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
      std::vector<GEOSGeometry*> rings;
      for (auto r = outline.polygon_offsets[p]; r < outline.polygon_offsets[p + 1]; ++r) {
        const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
        rings.push_back(ring(std::span(outline.points).subspan(begin, end - begin)));
      }
      polygons.push_back(GEOSGeom_createPolygon_r(geos_, rings[0], rings.data() + 1,
                                                  static_cast<unsigned>(rings.size() - 1)));
    }
    outline_ = GEOSGeom_createCollection_r(geos_, GEOS_MULTIPOLYGON, polygons.data(),
                                           static_cast<unsigned>(polygons.size()));
  }
  GeosClip(const GeosClip&) = delete;
  GeosClip& operator=(const GeosClip&) = delete;
  ~GeosClip() {
    GEOSGeom_destroy_r(geos_, outline_);
    GEOS_finish_r(geos_);
  }

  struct Left {
    double area = 0, length = 0;
    int parts = 0;
  };
  Left clip(std::span<const Point> cell) {
    GEOSGeometry* polygon = GEOSGeom_createPolygon_r(geos_, ring(cell), nullptr, 0);
    GEOSGeometry* left = GEOSIntersection_r(geos_, polygon, outline_);
    Left result;
    GEOSArea_r(geos_, left, &result.area);
    for (int k = 0; k < GEOSGetNumGeometries_r(geos_, left); ++k) {
      // Where the cell touches the outline, points and lines may be left besides.
      const GEOSGeometry* part = GEOSGetGeometryN_r(geos_, left, k);
      if (GEOSGeomTypeId_r(geos_, part) != GEOS_POLYGON || GEOSisEmpty_r(geos_, part) != 0) continue;
      double length = 0;
      GEOSLength_r(geos_, part, &length);
      result.length += length;
      ++result.parts;
    }
    GEOSGeom_destroy_r(geos_, left);
    GEOSGeom_destroy_r(geos_, polygon);
    return result;
  }

 private:
  GEOSGeometry* ring(std::span<const Point> points) {
    std::vector<Point> closed(points.begin(), points.end());
    closed.push_back(closed[0]);
    return GEOSGeom_createLinearRing_r(
        geos_,
        GEOSCoordSeq_copyFromBuffer_r(geos_, &closed[0].x, static_cast<unsigned>(closed.size()), 0, 0));
  }
  GEOSContextHandle_t geos_;
  GEOSGeometry* outline_ = nullptr;
};

}  // namespace vorpipe::test
