/// Which sites may cut which cells, and the bisector lines that backends clip by.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backend/backend.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// The candidates of `site[e]` are index[offsets[e]] .. index[offsets[e + 1] - 1], nearest first, without the
/// site itself. Every site not listed is at least reach[e] away from it; infinity if no other can cut.
/// Indices are those of the SiteSet; distances are in scaled units.
struct Candidates {
  std::vector<std::uint32_t> site;
  std::vector<std::uint32_t> offsets{0};
  std::vector<std::uint32_t> index;
  std::vector<double> reach;
};

/// The origin of a site's cell: the site, or the point of the domain nearest to it.
Point cellOrigin(const SiteSet& sites, std::uint32_t site);

/// Packs the entries [begin, end) of candidates. Differences are taken in double between the two
/// sites, then rounded; bounds and reach are rounded down, origin_offset up. Real is float or double.
template <class Real>
void packBatch(const SiteSet& sites, const Candidates& candidates, std::size_t begin, std::size_t end,
               int threads, CellBatch<Real>& out);

}  // namespace vorpipe::core
