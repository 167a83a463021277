#include <fmt/format.h>
#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include "core/outline.h"

namespace vorpipe {
namespace {

constexpr std::size_t most_points = std::numeric_limits<std::int32_t>::max();

tl::unexpected<Error> refuse(const std::string& what) {
  return tl::unexpected(Error{ErrorCode::input, "outline: " + what});
}

/// GEOS as one thread uses it, and what it said last.
class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {
    if (handle_ == nullptr) throw std::bad_alloc();
    GEOSContext_setErrorMessageHandler_r(
        handle_, [](const char* text, void* geos) { static_cast<Geos*>(geos)->message_ = text; }, this);
  }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  ~Geos() { GEOS_finish_r(handle_); }

  [[nodiscard]] GEOSContextHandle_t handle() const { return handle_; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  GEOSContextHandle_t handle_;
  std::string message_;
};

struct Destroy {
  GEOSContextHandle_t handle = nullptr;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  void operator()(char* text) const { GEOSFree_r(handle, text); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

Geometry owned(const Geos& geos, GEOSGeometry* geometry) { return {geometry, Destroy{geos.handle()}}; }

/// Gives up what is owned, for a function of GEOS that takes it.
std::vector<GEOSGeometry*> released(std::vector<Geometry>& geometries) {
  std::vector<GEOSGeometry*> taken;
  taken.reserve(geometries.size());
  for (auto& geometry : geometries) taken.push_back(geometry.release());
  return taken;
}

Geometry ringAs(const Geos& geos, const Outline& outline, std::size_t ring) {
  const auto begin = static_cast<std::ptrdiff_t>(outline.ring_offsets[ring]);
  const auto end = static_cast<std::ptrdiff_t>(outline.ring_offsets[ring + 1]);
  std::vector<Point> closed(outline.points.begin() + begin, outline.points.begin() + end);
  closed.push_back(closed.front());
  GEOSCoordSequence* points = GEOSCoordSeq_copyFromBuffer_r(
      geos.handle(), &closed.front().x, static_cast<unsigned>(closed.size()), /*hasZ=*/0, /*hasM=*/0);
  if (points == nullptr) return owned(geos, nullptr);
  return owned(geos, GEOSGeom_createLinearRing_r(geos.handle(), points));
}

Geometry polygonAs(const Geos& geos, const Outline& outline, std::size_t polygon) {
  std::vector<Geometry> holes;
  Geometry outer = ringAs(geos, outline, outline.polygon_offsets[polygon]);
  for (auto r = outline.polygon_offsets[polygon] + 1; r < outline.polygon_offsets[polygon + 1]; ++r) {
    holes.push_back(ringAs(geos, outline, r));
    if (!holes.back()) return owned(geos, nullptr);
  }
  if (!outer) return outer;
  const auto count = static_cast<unsigned>(holes.size());
  auto taken = released(holes);
  return owned(geos, GEOSGeom_createPolygon_r(geos.handle(), outer.release(), taken.data(), count));
}

Geometry geometryOf(const Geos& geos, const Outline& outline) {
  std::vector<Geometry> polygons;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    polygons.push_back(polygonAs(geos, outline, p));
    if (!polygons.back()) return owned(geos, nullptr);
  }
  const auto count = static_cast<unsigned>(polygons.size());
  auto taken = released(polygons);
  return owned(geos, GEOSGeom_createCollection_r(geos.handle(), GEOS_MULTIPOLYGON, taken.data(), count));
}

/// A number with the digits that it needs, to find the place in a file.
std::string placeOf(const Geos& geos, const GEOSGeometry* location) {
  double x = 0, y = 0;
  if (location == nullptr || GEOSGeomGetX_r(geos.handle(), location, &x) != 1 ||
      GEOSGeomGetY_r(geos.handle(), location, &y) != 1) {
    return {};
  }
  return fmt::format(" at ({}, {})", x, y);
}

Result<void> checkPolygons(const Outline& outline) {
  const Geos geos;
  const auto failed = [&] { return refuse(fmt::format("GEOS could not check it: {}", geos.message())); };
  const Geometry geometry = geometryOf(geos, outline);
  if (!geometry) return failed();
  char* reason = nullptr;
  GEOSGeometry* location = nullptr;
  const char valid = GEOSisValidDetail_r(geos.handle(), geometry.get(), 0, &reason, &location);
  const std::unique_ptr<char, Destroy> reason_owner(reason, Destroy{geos.handle()});
  const Geometry location_owner = owned(geos, location);
  if (valid == 1) return {};
  if (valid != 0) return failed();
  return refuse(fmt::format("{}{}; rings and polygons must not cross, overlap or share a side",
                            reason != nullptr ? reason : "not valid", placeOf(geos, location)));
}

bool areOffsets(const std::vector<std::uint64_t>& offsets, std::size_t count) {
  return offsets.size() > 1 && offsets.front() == 0 && offsets.back() == count &&
         std::ranges::is_sorted(offsets);
}

Result<void> checkRing(const Outline& outline, std::size_t ring) {
  const auto begin = outline.ring_offsets[ring], end = outline.ring_offsets[ring + 1];
  if (end - begin < 3) {
    return refuse(fmt::format("ring {} has {} points; it needs 3 or more", ring, end - begin));
  }
  for (auto p = begin; p < end; ++p) {
    const Point point = outline.points[p];
    if (std::isfinite(point.x) && std::isfinite(point.y)) continue;
    return refuse(
        fmt::format("point {} of ring {} is not finite: {}, {}", p - begin, ring, point.x, point.y));
  }
  return {};
}

}  // namespace

Result<void> checkOutline(const Outline& outline, Periodic periodic) {
  if (outline.empty()) return {};
  if (periodic != Periodic::none) {
    return refuse(
        "a periodic domain has none, since its cells reach beyond the domain; leave one of them out");
  }
  if (!areOffsets(outline.ring_offsets, outline.points.size()) ||
      !areOffsets(outline.polygon_offsets, outline.ring_offsets.size() - 1)) {
    return refuse("its offsets do not begin at 0, ascend, and end at the number of points and of rings");
  }
  if (outline.points.size() > most_points) {
    return refuse(fmt::format("{} points are more than {}", outline.points.size(), most_points));
  }
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    if (outline.polygon_offsets[p] == outline.polygon_offsets[p + 1]) {
      return refuse(fmt::format("polygon {} has no rings", p));
    }
  }
  for (std::size_t r = 0; r + 1 < outline.ring_offsets.size(); ++r) {
    if (auto checked = checkRing(outline, r); !checked) return checked;
  }
  return checkPolygons(outline);
}

}  // namespace vorpipe
