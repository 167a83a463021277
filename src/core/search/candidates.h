/// Which sites may cut which cells: what a search answers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// The candidates of `site[e]` are index[offsets[e]] .. index[offsets[e + 1] - 1], nearest first, without
/// the site itself. Every other site is at least reach[e] away from it: infinity, when no other can
/// cut. Indices are those of the SiteSet; distances are in scaled units.
///
/// `walls` is empty, or holds a box for each entry that its cell is known to lie in, seen from the cell's
/// origin; else that is the domain. A widened cell is the cell's Minkowski sum with a small box only if its
/// candidates are all sites near it, or if it is also clipped to its own widened bounding box.
struct Candidates {
  std::vector<std::uint32_t> site;
  std::vector<std::uint32_t> offsets{0};
  std::vector<std::uint32_t> index;
  std::vector<double> reach;
  std::vector<Box> walls;
};

}  // namespace vorpipe::core
