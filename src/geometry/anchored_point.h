/// Positions with more digits than a double has.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

/// A position as the unevaluated sum of an anchor, usually a site, and the vector from there. The difference
/// of two nearby positions is then rounded relative to their distance, not to their coordinates.
struct AnchoredPoint {
  Point base, rest;
};

inline Point positionOf(const AnchoredPoint& p) { return {p.base.x + p.rest.x, p.base.y + p.rest.y}; }

inline Point relativeTo(Point origin, const AnchoredPoint& p) {
  return {(p.base.x - origin.x) + p.rest.x, (p.base.y - origin.y) + p.rest.y};
}

/// The vector from a to b. wayBetween(b, a) is its exact negative.
inline Point wayBetween(const AnchoredPoint& a, const AnchoredPoint& b) {
  return {(b.base.x - a.base.x) + (b.rest.x - a.rest.x), (b.base.y - a.base.y) + (b.rest.y - a.rest.y)};
}

}  // namespace vorpipe::core
