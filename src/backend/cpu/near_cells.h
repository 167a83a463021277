/// Finds a few cells of many without a tree over all sites.
#pragma once

#include <span>

#include "backend/backend.h"
#include "backend/cpu/tree.h"

namespace vorpipe::cpu {

/// Finds the neighborhoods of the sites `which` of a set, with a tree over that set.
using FindOverTree = void (*)(const SiteSet& sites, const SiteTree& tree,
                              std::span<const std::uint32_t> which, int threads, CellNeighbors& out);

/// Finds each cell with `find` among the sites of the bins around it; unsecured if these are not enough, or
/// too many to be worthwhile.
void findNearby(const SiteSet& sites, std::span<const std::uint32_t> which, FindOverTree find, int threads,
                CellNeighbors& out);

/// Replaces the entries of `out` whose status is `unsecured` by those of `anew`, in order.
void replaceUnsecured(const CellNeighbors& anew, CellNeighbors& out);

}  // namespace vorpipe::cpu
