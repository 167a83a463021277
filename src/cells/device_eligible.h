/// Which cells a device is asked to find.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

struct Triage {
  std::vector<std::uint32_t> inside;   ///< sites whose cells a device is asked to find, ascending
  std::vector<std::uint32_t> outside;  ///< the others, ascending; the judge finds their cells
};

/// All sites of a set, ascending.
std::vector<std::uint32_t> allOf(const SiteSet& sites);

/// Gives a device the sites inside the domain. A site outside may be so far from its cell that a float cannot
/// decide whether the domain contains a little of it. Gives it none if squares of distances or weights may
/// not fit in a float: a site 1e15 domains away, or a weight of 1e18 squared domains, affects the search for
/// any cell.
Triage sortOut(const SiteSet& sites, int threads);

}  // namespace vorpipe::core
