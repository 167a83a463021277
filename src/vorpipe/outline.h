/// Mended (valid) outlines, and outlines of sites.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

struct MendedOutline {
  Outline outline;
  std::string changes;  ///< description of the changes; empty: none
};

/// How messages describe an outline in a plane that is not the caller's.
struct OutlineWords {
  std::function<Point(Point)> place{};  ///< converts a place to the caller's coordinates; empty: unchanged
  std::string_view unit_of_area{};      ///< suffix of areas
};

/// Dissolves polygons that touch along sides or overlap, such as neighboring districts, into their union. A
/// ring that crosses itself is refused unless `repair` is set: then the regions of odd winding number are
/// kept, minus holes. Rounding artifacts between polygons are dropped. A valid outline stays as it is. Errors
/// (input): those of checkInput for an outline; no part of it has an area.
Result<MendedOutline> mended(const Outline& outline, bool repair, const OutlineWords& words = {});

/// The convex hull of sites, grown on every side by `margin`, which is 0 or more. Errors (input): the sites
/// lie on a line, or one is not finite.
Result<Outline> hullOf(const Sites& sites, double margin);

}  // namespace vorpipe
