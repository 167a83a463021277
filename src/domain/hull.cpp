#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "base/refusal.h"
#include "domain/geos_outline.h"

namespace vorpipe {
namespace {

/// The convex hull; a line if all sites lie on one; null if GEOS refuses.
GeosGeometry hullIn(const Geos& geos, const Sites& sites) {
  GEOSCoordSequence* sequence = GEOSCoordSeq_copyFromArrays_r(
      geos.handle(), sites.x.data(), sites.y.data(), nullptr, nullptr, static_cast<unsigned>(sites.size()));
  if (sequence == nullptr) return owned(geos, nullptr);
  const GeosGeometry line = owned(geos, GEOSGeom_createLineString_r(geos.handle(), sequence));
  return owned(geos, line ? GEOSConvexHull_r(geos.handle(), line.get()) : nullptr);
}

Result<Outline> makeHull(const Sites& sites, double margin) {
  const Geos geos;
  const auto failed = [&] {
    return core::refuseOutline(fmt::format("GEOS could not make the hull: {}", geos.message()));
  };
  GeosGeometry hull = hullIn(geos, sites);
  if (!hull) return failed();
  const int type = GEOSGeomTypeId_r(geos.handle(), hull.get());
  const bool has_area = type == GEOS_POLYGON;
  // A margin turns a line into a rectangle.
  if (!has_area && (type != GEOS_LINESTRING || !(margin > 0))) {
    return core::refuseOutline(
        fmt::format("the hull of the sites has no area: they all {}",
                    type == GEOS_LINESTRING ? "lie on a line, which takes a margin" : "stand in one place"));
  }
  if (margin > 0) {
    constexpr int quadrant_segments = 8;
    constexpr double mitre_limit = 5;
    hull = owned(geos, GEOSBufferWithStyle_r(geos.handle(), hull.get(), margin, quadrant_segments,
                                             has_area ? GEOSBUF_CAP_FLAT : GEOSBUF_CAP_SQUARE,
                                             GEOSBUF_JOIN_MITRE, mitre_limit));
  }
  Outline outline;
  if (!hull || !core::addPolygons(geos, hull.get(), outline)) return failed();
  if (outline.empty()) {
    return core::refuseOutline(fmt::format(
        "the hull of the sites with a margin of {} has no area in GEOS: scale the sites", margin));
  }
  return outline;
}

}  // namespace

Result<Outline> hullOf(const Sites& sites, double margin) {
  if (!(margin >= 0) || !std::isfinite(margin)) {
    return core::refuseOutline(fmt::format("a margin of {} is none: it must be 0 or more", margin));
  }
  const auto isFinite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(sites.x, isFinite) || !std::ranges::all_of(sites.y, isFinite)) {
    return tl::unexpected(refusalOf(Subject::sites, "one has a coordinate that is not finite"));
  }
  const std::size_t fewest = margin > 0 ? 2 : 3;
  if (sites.size() < fewest) {
    return core::refuseOutline(
        fmt::format("the hull of {} {} has no area: it takes 3 that do not lie on a line, or "
                    "2 with a margin",
                    sites.size(), sites.size() == 1 ? "site" : "sites"));
  }
  try {
    return makeHull(sites, margin);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "there is not enough memory for the hull of the sites"});
  }
}

}  // namespace vorpipe
