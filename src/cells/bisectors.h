/// From candidates to the bisector lines that backends clip by.
#pragma once

#include "backend/backend.h"
#include "cells/candidates.h"

namespace vorpipe::core {

/// The origin of a site's cell: the site, or the point of the domain nearest to it.
Point cellOrigin(const SiteSet& sites, std::uint32_t site);

/// Packs the entries [begin, end) of candidates. Differences are taken in double between the two
/// sites, then rounded; bounds and reach are rounded down, origin_offset up. Real is float or double.
template <class Real>
void packBatch(const SiteSet& sites, const Candidates& candidates, std::size_t begin, std::size_t end,
               int threads, CellBatch<Real>& out);

}  // namespace vorpipe::core
