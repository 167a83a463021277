#include "domain/geos_outline.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/try.h"
#include "domain/rings.h"

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

constexpr std::size_t most_points = std::numeric_limits<std::int32_t>::max();

/// The position with as many digits as needed to find it in a file.
std::string placeOf(const Geos& geos, const GEOSGeometry* location,
                    const std::function<Point(Point)>& place) {
  Point at{0, 0};
  if (!readPoint(geos, location, at)) return {};
  if (place) at = place(at);
  return fmt::format(" at ({}, {})", at.x, at.y);
}

Result<void> checkPolygons(const Outline& outline) {
  const Geos geos;
  const GeosGeometry geometry = geometryOf(geos, outline);
  VORPIPE_LET(fault, faultOf(geos, geometry.get()));
  if (!fault) return {};
  return refuseOutline(fmt::format("{}; rings and polygons must not cross, overlap or share a side", *fault));
}

bool areOffsets(const std::vector<std::uint64_t>& offsets, std::size_t count) {
  return offsets.size() > 1 && offsets.front() == 0 && offsets.back() == count &&
         std::ranges::is_sorted(offsets);
}

Result<void> checkRing(const Outline& outline, std::size_t ring) {
  const auto points = ringAt(outline, ring);
  if (points.size() < 3) {
    return refuseOutline(fmt::format("ring {} has {} points; it needs 3 or more", ring, points.size()));
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto [x, y] = points[p];
    if (std::isfinite(x) && std::isfinite(y)) continue;
    return refuseOutline(fmt::format("point {} of ring {} is not finite: {}, {}", p, ring, x, y));
  }
  return {};
}

/// Refuses sizes for which neither GEOS nor the areas of cells are reliable.
Result<void> checkSize(const Outline& outline) {
  const Box box = boxOf(outline.points);
  const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
  if (!std::isnormal(width * height))
    return refuseOutline(fmt::format("its box of {} x {} has no area that a double can hold", width, height));
  // Corners are rounded where the outline crosses cells; with fewer steps of a coordinate nothing would
  // remain.
  constexpr double least = 256 * std::numeric_limits<double>::epsilon();
  const double x = std::max(std::abs(box.xmin), std::abs(box.xmax));
  const double y = std::max(std::abs(box.ymin), std::abs(box.ymax));
  if (width >= least * x && height >= least * y) return {};
  return refuseOutline(
      fmt::format("its box of {} x {} is too small beside its coordinates, {} and {}: it must be {:.0e} "
                  "of them; move it nearer to the origin",
                  width, height, x, y, least));
}

}  // namespace

GeosGeometry polygonOf(const Geos& geos, const Outline& outline, std::size_t polygon) {
  std::vector<GeosGeometry> rings;
  for (auto r = outline.polygon_offsets[polygon]; r < outline.polygon_offsets[polygon + 1]; ++r) {
    rings.push_back(geosRing(geos, ringAt(outline, r)));
  }
  return geosPolygon(geos, std::move(rings));
}

GeosGeometry geometryOf(const Geos& geos, const Outline& outline) {
  std::vector<GeosGeometry> polygons;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    polygons.push_back(polygonOf(geos, outline, p));
    if (!polygons.back()) return owned(geos, nullptr);
  }
  return collected(geos, GEOS_MULTIPOLYGON, std::move(polygons));
}

GeosGeometry collected(const Geos& geos, int kind, std::vector<GeosGeometry> parts) {
  const auto isNull = [](const GeosGeometry& part) { return part == nullptr; };
  if (std::ranges::any_of(parts, isNull)) return owned(geos, nullptr);
  auto taken = released(parts);
  return owned(geos, GEOSGeom_createCollection_r(geos.handle(), kind, taken.data(),
                                                 static_cast<unsigned>(taken.size())));
}

bool readPoint(const Geos& geos, const GEOSGeometry* point, Point& at) {
  return point != nullptr && GEOSGeomGetX_r(geos.handle(), point, &at.x) == 1 &&
         GEOSGeomGetY_r(geos.handle(), point, &at.y) == 1;
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

Result<std::optional<std::string>> faultOf(const Geos& geos, const GEOSGeometry* geometry,
                                           const std::function<Point(Point)>& place) {
  const auto failed = [&] {
    return refuseOutline(fmt::format("GEOS could not check it: {}", geos.message()));
  };
  if (geometry == nullptr) return failed();
  char* reason = nullptr;
  GEOSGeometry* location = nullptr;
  const char valid = GEOSisValidDetail_r(geos.handle(), geometry, 0, &reason, &location);
  const std::unique_ptr<char, GeosDestroy> reason_owner(reason, GeosDestroy{geos.handle()});
  const GeosGeometry location_owner = owned(geos, location);
  if (valid == 1) return std::nullopt;
  if (valid != 0) return failed();
  return (reason != nullptr ? reason : "not valid") + placeOf(geos, location, place);
}

Result<void> checkRings(const Outline& outline) {
  if (!areOffsets(outline.ring_offsets, outline.points.size()) ||
      !areOffsets(outline.polygon_offsets, outline.ring_offsets.size() - 1)) {
    return refuseOutline(
        "its offsets do not begin at 0, ascend, and end at the number of points and of rings");
  }
  if (outline.points.size() > most_points) {
    return refuseOutline(fmt::format("{} points are more than {}", outline.points.size(), most_points));
  }
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    if (outline.polygon_offsets[p] == outline.polygon_offsets[p + 1]) {
      return refuseOutline(fmt::format("polygon {} has no rings", p));
    }
  }
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    VORPIPE_TRY(checkRing(outline, r));
  }
  return checkSize(outline);
}

Result<void> checkOutline(const Outline& outline, Periodic periodic) {
  if (outline.empty()) return {};
  if (periodic != Periodic::none) {
    return refuseOutline(
        "a periodic domain has none, since its cells reach beyond the domain; leave one of them out");
  }
  VORPIPE_TRY(checkRings(outline));
  return checkPolygons(outline);
}

}  // namespace vorpipe::core
