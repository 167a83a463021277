/// Outlines made valid, and outlines of sites.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

struct MendedOutline {
  Outline outline;
  std::string changes;  ///< what was changed, in words; empty: nothing
};

/// How messages tell of an outline in a plane that is not the caller's.
struct OutlineWords {
  std::function<Point(Point)> place{};  ///< where a place is for the caller; empty: there
  std::string_view unit_of_area{};      ///< after areas
};

/// Dissolves polygons that touch along sides or overlap, as those of neighboring districts do, into what they
/// cover together. A ring that crosses itself is refused, unless `repair` is set: then what it winds around
/// an odd number of times is kept, without what holes do. What rounding leaves between polygons is left out.
/// An outline that is valid stays as it is. Errors (input): as checkInput's for an outline; nothing of it has
/// an area.
Result<MendedOutline> mended(const Outline& outline, bool repair, const OutlineWords& words = {});

/// The convex hull of sites, grown on every side by `margin`, which is 0 or more. Errors (input): the sites
/// lie on a line, or one is not finite.
Result<Outline> hullOf(const Sites& sites, double margin);

}  // namespace vorpipe
