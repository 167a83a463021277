/// Polygons in GEOS.
#pragma once

#include <geos_c.h>

#include <memory>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// A GEOS context for one thread, with its last error message. Throws std::bad_alloc.
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
  /// Returns the last error message. Throws std::bad_alloc if that is the message: then the input is not at
  /// fault.
  [[nodiscard]] const std::string& message() const {
    if (message_ == "std::bad_alloc") throw std::bad_alloc();
    return message_;
  }

 private:
  GEOSContextHandle_t handle_;
  std::string message_;
};

struct GeosDestroy {
  GEOSContextHandle_t handle = nullptr;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  void operator()(char* text) const { GEOSFree_r(handle, text); }
};

/// Null if GEOS refused.
using GeosGeometry = std::unique_ptr<GEOSGeometry, GeosDestroy>;

inline GeosGeometry owned(const Geos& geos, GEOSGeometry* geometry) {
  return {geometry, GeosDestroy{geos.handle()}};
}

/// Releases ownership, for a GEOS function that takes it.
inline std::vector<GEOSGeometry*> released(std::span<GeosGeometry> geometries) {
  std::vector<GEOSGeometry*> taken;
  taken.reserve(geometries.size());
  for (auto& geometry : geometries) taken.push_back(geometry.release());
  return taken;
}

/// Returns a ring of at least one point; the first is not repeated at the end of `points`.
inline GeosGeometry geosRing(const Geos& geos, std::span<const Point> points) {
  std::vector<Point> closed(points.begin(), points.end());
  closed.push_back(closed.front());
  GEOSCoordSequence* sequence = GEOSCoordSeq_copyFromBuffer_r(
      geos.handle(), &closed.front().x, static_cast<unsigned>(closed.size()), /*hasZ=*/0, /*hasM=*/0);
  return owned(geos, sequence == nullptr ? nullptr : GEOSGeom_createLinearRing_r(geos.handle(), sequence));
}

/// Returns a polygon with an outer ring and its holes; null if any ring is null.
inline GeosGeometry geosPolygon(const Geos& geos, std::vector<GeosGeometry> rings) {
  for (const auto& ring : rings) {
    if (!ring) return owned(geos, nullptr);
  }
  auto holes = released(std::span(rings).subspan(1));
  return owned(geos, GEOSGeom_createPolygon_r(geos.handle(), rings.front().release(), holes.data(),
                                              static_cast<unsigned>(holes.size())));
}

}  // namespace vorpipe
