#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "base/try.h"
#include "domain/geos_outline.h"
#include "domain/refused.h"
#include "domain/rings.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t most_points = std::numeric_limits<std::int32_t>::max();

/// The position with as many digits as needed to find it in a file.
std::string placeOf(const Geos& geos, const GEOSGeometry* location,
                    const std::function<Point(Point)>& place) {
  Point at{0, 0};
  if (location == nullptr || GEOSGeomGetX_r(geos.handle(), location, &at.x) != 1 ||
      GEOSGeomGetY_r(geos.handle(), location, &at.y) != 1) {
    return {};
  }
  if (place) at = place(at);
  return fmt::format(" at ({}, {})", at.x, at.y);
}

Result<void> checkPolygons(const Outline& outline) {
  const Geos geos;
  const GeosGeometry geometry = geometryOf(geos, outline);
  const auto fault = faultOf(geos, geometry.get());
  if (!fault) return tl::unexpected(fault.error());
  if (!*fault) return {};
  return refuseOutline(
      fmt::format("{}; rings and polygons must not cross, overlap or share a side", **fault));
}

bool areOffsets(const std::vector<std::uint64_t>& offsets, std::size_t count) {
  return offsets.size() > 1 && offsets.front() == 0 && offsets.back() == count &&
         std::ranges::is_sorted(offsets);
}

Result<void> checkRing(const Outline& outline, std::size_t ring) {
  const auto begin = outline.ring_offsets[ring], end = outline.ring_offsets[ring + 1];
  if (end - begin < 3) {
    return refuseOutline(fmt::format("ring {} has {} points; it needs 3 or more", ring, end - begin));
  }
  for (auto p = begin; p < end; ++p) {
    const Point point = outline.points[p];
    if (std::isfinite(point.x) && std::isfinite(point.y)) continue;
    return refuseOutline(
        fmt::format("point {} of ring {} is not finite: {}, {}", p - begin, ring, point.x, point.y));
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
