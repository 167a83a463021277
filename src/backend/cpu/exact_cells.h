/// Finds cells with as many digits as necessary.
#pragma once

#include <span>

#include "backend/cpu/tree.h"

namespace vorpipe::cpu {

/// Finds the neighborhoods of the sites `which`. Every one is certified or empty (or unsecured, where the set
/// is a tile). Whatever a thousand bits cannot distinguish is a tie.
void findExactly(const SiteSet& sites, const SiteTree& tree, std::span<const std::uint32_t> which,
                 int threads, CellNeighbors& out);

}  // namespace vorpipe::cpu
