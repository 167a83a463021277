/// Planes that touch the Earth, in which outlines are.
#pragma once

#include <vector>

#include "domain/rings.h"
#include "globe/direction.h"
#include "vorpipe/outline.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe::core {

/// The gnomonic projection around a center (Snyder 1987, chapter 22), for places less than 90 degrees from
/// it. Cells on the sphere are those of a plane power diagram there: x . v, for x = center + u right + v up,
/// is largest for the site of least power (globe.md).
class Chart {
 public:
  explicit Chart(Point center);

  /// Whether a place is less than 90 degrees from the center.
  [[nodiscard]] bool isNear(const Direction& at) const { return dot(center_, at) > 0; }
  [[nodiscard]] Point toPlane(const Direction& at) const;
  [[nodiscard]] Direction toDirection(Point at) const;
  /// The plane's sites, of all sites on the sphere.
  [[nodiscard]] Sites toPlane(const SphereSites& sites, int threads) const;

 private:
  Direction center_, right_, up_;
};

/// Polygons that one chart has.
struct ChartedOutline {
  Point center;  ///< degrees
  Outline degrees;
};

/// Distributes the polygons of an outline in degrees among as few charts as come of it: each begins with the
/// first polygon that is left, amid which it has its center. Errors (input): the outline is invalid; one of
/// its polygons reaches too far around the Earth.
Result<std::vector<ChartedOutline>> chartsOf(const Outline& outline);

/// A chart's outline in its plane. Sides along parallels have points in between.
Result<Outline> outlineIn(const Chart& chart, const ChartedOutline& charted);

/// A polygon on the sphere: its outer ring, and holes. The inside lies to the left of all.
using SpherePolygon = std::vector<std::vector<Direction>>;

/// The polygons of an outline, as cells have them, whose sides are great circles. Errors: those of chartsOf.
Result<std::vector<SpherePolygon>> spherePolygonsOf(const Outline& outline);

}  // namespace vorpipe::core
