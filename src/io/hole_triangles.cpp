#include "io/hole_triangles.h"

#include <geos_c.h>

#include <memory>
#include <utility>

namespace vorpipe {
namespace {

using Context = std::unique_ptr<GEOSContextHandle_HS, decltype(&GEOS_finish_r)>;
using Triangles = std::vector<std::array<Point, 3>>;

/// A geometry and what it belongs to.
class Geometry {
 public:
  Geometry(GEOSContextHandle_t context, GEOSGeometry* geometry) : context_(context), geometry_(geometry) {}
  Geometry(Geometry&& other) noexcept
      : context_(other.context_), geometry_(std::exchange(other.geometry_, nullptr)) {}
  Geometry& operator=(Geometry&&) = delete;
  ~Geometry() { GEOSGeom_destroy_r(context_, geometry_); }

  [[nodiscard]] const GEOSGeometry* get() const { return geometry_; }
  [[nodiscard]] GEOSGeometry* release() { return std::exchange(geometry_, nullptr); }

 private:
  GEOSContextHandle_t context_;
  GEOSGeometry* geometry_;
};

Geometry lineOf(GEOSContextHandle_t context, std::span<const Point> vertices) {
  std::vector<double> coordinates;
  for (const Point& vertex : vertices) coordinates.insert(coordinates.end(), {vertex.x, vertex.y});
  coordinates.insert(coordinates.end(), {vertices.front().x, vertices.front().y});
  auto* const sequence = GEOSCoordSeq_copyFromBuffer_r(context, coordinates.data(),
                                                       static_cast<unsigned>(vertices.size() + 1), 0, 0);
  return {context, sequence == nullptr ? nullptr : GEOSGeom_createLinearRing_r(context, sequence)};
}

Geometry polygonOf(GEOSContextHandle_t context, const Diagram& diagram, std::span<const Ring> piece) {
  std::vector<Geometry> lines;
  for (const Ring& ring : piece) {
    lines.push_back(lineOf(context, verticesOf(diagram, ring)));
    if (lines.back().get() == nullptr) return {context, nullptr};
  }
  std::vector<GEOSGeometry*> holes;
  for (std::size_t k = 1; k < lines.size(); ++k) holes.push_back(lines[k].release());
  return {context, GEOSGeom_createPolygon_r(context, lines.front().release(), holes.data(),
                                            static_cast<unsigned>(holes.size()))};
}

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
  const Context context(GEOS_init_r(), GEOS_finish_r);
  const Geometry polygon = polygonOf(context.get(), diagram, piece);
  if (polygon.get() == nullptr) return std::nullopt;
  const Geometry found(context.get(), GEOSConstrainedDelaunayTriangulation_r(context.get(), polygon.get()));
  if (found.get() == nullptr) return std::nullopt;
  const int count = GEOSGetNumGeometries_r(context.get(), found.get());
  Triangles triangles;
  for (int k = 0; k < count; ++k) {
    triangles.push_back(cornersOf(context.get(), GEOSGetGeometryN_r(context.get(), found.get(), k)));
  }
  return triangles;
}

}  // namespace vorpipe
