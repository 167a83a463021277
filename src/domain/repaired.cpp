#include "domain/repaired.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "domain/edge_tree.h"
#include "domain/rings.h"

namespace vorpipe::core {
namespace {

/// The rings of a polygon unchanged; they may cross.
Rings ringsOf(const Outline& outline, std::size_t polygon) {
  Rings rings;
  rings.offsets.push_back(0);
  for (auto r = outline.polygon_offsets[polygon]; r < outline.polygon_offsets[polygon + 1]; ++r) {
    const auto begin = outline.ring_offsets[r], end = outline.ring_offsets[r + 1];
    const auto points = std::span(outline.points).subspan(begin, end - begin);
    rings.points.insert(rings.points.end(), points.begin(), points.end());
    rings.ring.insert(rings.ring.end(), points.size(), static_cast<std::uint32_t>(rings.offsets.size() - 1));
    rings.offsets.push_back(static_cast<std::uint32_t>(rings.points.size()));
  }
  return rings;
}

/// Decides which places belong to a polygon.
class Windings {
 public:
  explicit Windings(const Rings& rings)
      : rings_(rings), index_(rings), xmax_(boxOf(rings.points).xmax), odd_(rings.offsets.size() - 1) {}

  /// Whether the first ring winds around p an odd number of times, and none of the others does.
  bool contains(Point p) {
    std::fill(odd_.begin(), odd_.end(), false);
    index_.edgesIn({p.x, p.y, std::max(p.x, xmax_), p.y}, edges_);
    for (const auto e : edges_) {
      const auto ring = rings_.ring[e];
      odd_[ring] = odd_[ring] != crossesRay(rings_.points[e], rings_.points[rings_.next(e)], p);
    }
    return odd_.front() && std::find(odd_.begin() + 1, odd_.end(), true) == odd_.end();
  }

 private:
  const Rings& rings_;
  OutlineIndex index_;
  double xmax_;
  std::vector<bool> odd_;  ///< by ring
  std::vector<std::uint32_t> edges_;
};

GeosGeometry collected(const Geos& geos, int kind, std::vector<GeosGeometry> parts) {
  if (!std::ranges::all_of(parts, [](const GeosGeometry& part) { return part != nullptr; }))
    return owned(geos, nullptr);
  auto taken = released(parts);
  return owned(geos, GEOSGeom_createCollection_r(geos.handle(), kind, taken.data(),
                                                 static_cast<unsigned>(taken.size())));
}

/// All faces that rings separate from each other, as polygons.
GeosGeometry facesOf(const Geos& geos, const Rings& rings) {
  std::vector<GeosGeometry> lines;
  for (std::size_t r = 0; r + 1 < rings.offsets.size(); ++r) {
    const auto begin = rings.offsets[r], end = rings.offsets[r + 1];
    lines.push_back(geosRing(geos, std::span(rings.points).subspan(begin, end - begin)));
  }
  const GeosGeometry crossing = collected(geos, GEOS_GEOMETRYCOLLECTION, std::move(lines));
  if (!crossing) return owned(geos, nullptr);
  const GeosGeometry parted = owned(geos, GEOSUnaryUnion_r(geos.handle(), crossing.get()));
  if (!parted) return owned(geos, nullptr);
  const GEOSGeometry* const all = parted.get();
  return owned(geos, GEOSPolygonize_r(geos.handle(), &all, 1));
}

}  // namespace

GeosGeometry repairedPolygon(const Geos& geos, const Outline& outline, std::size_t polygon) {
  const Rings rings = ringsOf(outline, polygon);
  const GeosGeometry faces = facesOf(geos, rings);
  if (!faces) return owned(geos, nullptr);
  Windings windings(rings);
  std::vector<GeosGeometry> kept;
  const int count = GEOSGetNumGeometries_r(geos.handle(), faces.get());
  for (int k = 0; k < count; ++k) {
    const GEOSGeometry* const face = GEOSGetGeometryN_r(geos.handle(), faces.get(), k);
    const GeosGeometry within = owned(geos, GEOSPointOnSurface_r(geos.handle(), face));
    Point p{0, 0};
    if (!within || GEOSGeomGetX_r(geos.handle(), within.get(), &p.x) != 1 ||
        GEOSGeomGetY_r(geos.handle(), within.get(), &p.y) != 1) {
      return owned(geos, nullptr);
    }
    if (windings.contains(p)) kept.push_back(owned(geos, GEOSGeom_clone_r(geos.handle(), face)));
  }
  const GeosGeometry parts = collected(geos, GEOS_MULTIPOLYGON, std::move(kept));
  return owned(geos, parts ? GEOSUnaryUnion_r(geos.handle(), parts.get()) : nullptr);
}

}  // namespace vorpipe::core
