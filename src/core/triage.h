/// Which cells a device is asked for.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

struct Triage {
  std::vector<std::uint32_t> inside;   ///< sites inside the domain, ascending
  std::vector<std::uint32_t> outside;  ///< the others, ascending; their cells are the judge's
};

/// As far as a site outside the domain is from its cell, a float is too coarse to say whether the domain
/// holds a little of it.
Triage sortOut(const SiteSet& sites, int threads);

}  // namespace vorpipe
