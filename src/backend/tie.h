/// How short an edge is a tie: in neither of its cells.
#pragma once

#include <algorithm>

#include "backend/backend.h"

namespace vorpipe {

/// An edge is a tie when it is shorter than this part of the distance between its two sites, or of the
/// domain's shorter side if that is less: a domain that is small among its sites has cells all the same.
inline constexpr double shortest_edge = 1e-6;

/// What the length of an edge is compared with a part of, given the distance between its sites.
template <class Real>
Real tieScale(const Real& distance, double shorter_side) {
  return distance < Real(shorter_side) ? distance : Real(shorter_side);
}

inline double shorterSide(const Box& domain) {
  return std::min(domain.xmax - domain.xmin, domain.ymax - domain.ymin);
}

/// Of the caller's domain; where that is periodic, `sites.domain` is larger.
inline double shorterSide(const SiteSet& sites) {
  return std::min(shorterSide(sites.domain), sites.shorter_side);
}

}  // namespace vorpipe
