/// Outlines made valid, and outlines of sites.
#pragma once

#include <string>

#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

struct MendedOutline {
  Outline outline;
  std::string changes;  ///< what was changed, in words; empty: nothing
};

/// Dissolves polygons that touch or overlap, as those of neighboring districts do, into what they cover
/// together. A ring that crosses itself is refused, unless `repair` is set: then what it winds around is
/// kept. An outline that is valid stays as it is. Errors (input): as checkInput's for an outline; nothing of
/// an area is left.
Result<MendedOutline> mended(const Outline& outline, bool repair);

/// The convex hull of sites, grown on every side by `margin`, which is 0 or more. Error (input): it has no
/// area.
Result<Outline> hullOf(const Sites& sites, double margin);

}  // namespace vorpipe
