/// Which sites may cut which cells: the result of a search.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

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

}  // namespace vorpipe::core
