#include <fmt/core.h>

#include <cmath>

#include "base/refusal.h"
#include "base/try.h"
#include "domain/rings.h"
#include "vorpipe/globe.h"
#include "vorpipe/maps.h"

namespace vorpipe {
namespace {

double areaOf(const Outline& outline) {
  double sum = 0;
  for (std::size_t p = 0; p + 1 < outline.polygon_offsets.size(); ++p) {
    for (auto r = outline.polygon_offsets[p]; r < outline.polygon_offsets[p + 1]; ++r) {
      const double area = std::abs(core::areaOfRing(core::ringAt(outline, r)));
      sum += r > outline.polygon_offsets[p] ? -area : area;
    }
  }
  return sum;
}

}  // namespace

Result<MendedOutline> mendedOnGlobe(const Outline& degrees, bool repair) {
  // Where the plane of this projection ends, opposite to its center, a polygon would be turned inside out.
  constexpr double most_of_plane = 0.6;
  constexpr double earth_area = 510065621.7;  // km2
  VORPIPE_LET(projection, projectionAmid(degrees));
  VORPIPE_VAR(mended, mendedToPlane(projection, degrees, repair));
  if (areaOf(mended.outline) > most_of_plane * earth_area) {
    const Point center = projection.center();
    return tl::unexpected(
        refusalOf(Subject::outline,
                  fmt::format("it goes around the Earth, or covers what is opposite to its center {}, "
                              "{}; take its parts one by one",
                              center.x, center.y)));
  }
  for (Point& point : mended.outline.points) point = projection.toDegrees(point);
  return mended;
}

}  // namespace vorpipe
