/// Polygons as GEOS has them.
#pragma once

#include <geos_c.h>

#include <memory>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// GEOS as one thread uses it, and what it said last. Throws std::bad_alloc.
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
  /// Throws std::bad_alloc where that is what it said: nothing is wrong with what it was given.
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

/// None where GEOS refused.
using GeosGeometry = std::unique_ptr<GEOSGeometry, GeosDestroy>;

inline GeosGeometry owned(const Geos& geos, GEOSGeometry* geometry) {
  return {geometry, GeosDestroy{geos.handle()}};
}

/// Gives up what is owned, for a function of GEOS that takes it.
inline std::vector<GEOSGeometry*> released(std::span<GeosGeometry> geometries) {
  std::vector<GEOSGeometry*> taken;
  taken.reserve(geometries.size());
  for (auto& geometry : geometries) taken.push_back(geometry.release());
  return taken;
}

/// A ring of at least one point, of which the first is not repeated at the end.
inline GeosGeometry geosRing(const Geos& geos, std::span<const Point> points) {
  std::vector<Point> closed(points.begin(), points.end());
  closed.push_back(closed.front());
  GEOSCoordSequence* sequence = GEOSCoordSeq_copyFromBuffer_r(
      geos.handle(), &closed.front().x, static_cast<unsigned>(closed.size()), /*hasZ=*/0, /*hasM=*/0);
  return owned(geos, sequence == nullptr ? nullptr : GEOSGeom_createLinearRing_r(geos.handle(), sequence));
}

/// A polygon of an outer ring and its holes; none if any of them is none.
inline GeosGeometry geosPolygon(const Geos& geos, std::vector<GeosGeometry> rings) {
  for (const auto& ring : rings) {
    if (!ring) return owned(geos, nullptr);
  }
  auto holes = released(std::span(rings).subspan(1));
  return owned(geos, GEOSGeom_createPolygon_r(geos.handle(), rings.front().release(), holes.data(),
                                              static_cast<unsigned>(holes.size())));
}

}  // namespace vorpipe
