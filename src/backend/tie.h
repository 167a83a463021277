/// The length below which an edge is a tie; a tie is in neither of its cells.
#pragma once

#include <algorithm>

#include "backend/backend.h"

namespace vorpipe {

/// An edge is a tie when it is shorter than this fraction of the distance between its two sites, or of the
/// domain's shorter side if that is less. Thus a domain that is small compared with its sites' distances
/// still has cells.
inline constexpr double shortest_edge = 1e-6;

/// Returns the length of which a fraction is the limit for ties, given the distance between an edge's sites.
template <class Real>
Real tieScale(const Real& distance, double shorter_side) {
  return distance < Real(shorter_side) ? distance : Real(shorter_side);
}

inline double shorterSide(const Box& domain) {
  return std::min(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
}

/// Returns the shorter side of the caller's domain; if that is periodic, `sites.domain` is larger.
inline double shorterSide(const SiteSet& sites) {
  return std::min(shorterSide(sites.domain), sites.shorter_side);
}

}  // namespace vorpipe
