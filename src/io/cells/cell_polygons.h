/// Rings of a cell, and its polygons for files of features.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <span>
#include <vector>

#include "io/base/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe {

/// A closed line of at least three vertices; the first is not repeated at its end.
struct Ring {
  std::uint64_t begin, end;  ///< in Diagram::vertices
  bool hole;
};

/// Returns the rings of the site's cell in the diagram's order: each outer ring, then its holes. None if the
/// cell has no polygon.
std::vector<Ring> ringsOf(const Diagram& diagram, std::size_t site);

/// Whether the site's cell has a polygon.
bool hasPolygon(const Diagram& diagram, std::size_t site);

inline std::span<const Point> verticesOf(const Diagram& diagram, const Ring& ring) {
  return std::span(diagram.vertices).subspan(ring.begin, ring.end - ring.begin);
}

/// The polygons of a cell. Each is a list of rings of points: an outer ring, then its holes. A ring does not
/// repeat its first point. In degrees from a projection, strongly bent edges get points in between (decision
/// D135). There, a ring around a pole also follows the meridian opposite to the center to the pole and back,
/// or to the hole around the pole, so that it is a polygon of longitude and latitude (decision D126). Those
/// on the globe are as in globePolygons. The diagram must outlive this.
class CellPolygons {
 public:
  using Rings = std::vector<std::span<const Point>>;

  CellPolygons(const Sites& sites, const Diagram& diagram, std::size_t site, const CoordinateSystem& system);

  [[nodiscard]] bool empty() const { return polygons_.empty(); }
  [[nodiscard]] std::size_t size() const { return polygons_.size(); }
  [[nodiscard]] const Rings& operator[](std::size_t polygon) const { return polygons_[polygon]; }

 private:
  void addOnGlobe(const Outline& outline);

  std::vector<Rings> polygons_;
  std::list<std::vector<Point>> new_rings_;  ///< rings that are not in the diagram
};

}  // namespace vorpipe
