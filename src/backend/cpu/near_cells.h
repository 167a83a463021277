/// A few cells of many, found without a tree over all sites.
#pragma once

#include <span>

#include "backend/backend.h"
#include "backend/cpu/tree.h"

namespace vorpipe::cpu {

/// Finds the neighborhoods of the sites `which` of a set, over a tree of it.
using FindOverTree = void (*)(const SiteSet& sites, const SiteTree& tree,
                              std::span<const std::uint32_t> which, int threads, CellNeighbors& out);

/// Finds each cell by `find` among the sites of the bins around it: unsecured where those are not enough,
/// or too many to be worth their while.
void findNearby(const SiteSet& sites, std::span<const std::uint32_t> which, FindOverTree find, int threads,
                CellNeighbors& out);

/// Replaces the entries of `out` whose status is `unsecured` by those of `anew`, in order.
void replaceUnsecured(const CellNeighbors& anew, CellNeighbors& out);

}  // namespace vorpipe::cpu
