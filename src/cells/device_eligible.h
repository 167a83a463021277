/// Which cells a device is asked for.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

struct Triage {
  std::vector<std::uint32_t> inside;   ///< sites whose cells a device is asked for, ascending
  std::vector<std::uint32_t> outside;  ///< the others, ascending; their cells are the judge's
};

/// All sites of a set, ascending.
std::vector<std::uint32_t> allOf(const SiteSet& sites);

/// A device gets the sites inside the domain: as far as one outside is from its cell, a float is too coarse
/// to say whether the domain holds a little of it. It gets none where squares of distances or weights may not
/// fit in a float: a site 1e15 domains away, or a weight of 1e18 squared domains, touches the search of any
/// cell.
Triage sortOut(const SiteSet& sites, int threads);

}  // namespace vorpipe::core
