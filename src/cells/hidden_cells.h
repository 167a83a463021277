/// Proofs that cells are empty: sites with weights hide others (decision D74).
#pragma once

#include <span>

#include "cells/neighbor_rows.h"

namespace vorpipe::core {

/// Whether the bisectors of `cell` with the sites among `lines` leave no part of the domain with positive
/// area. Exact for coordinates in the range of predicates.h; returns false beyond it.
bool leaveNothing(const SiteSet& sites, std::uint32_t cell, std::span<const std::int32_t> lines);

/// In a set with weights, removes the lines of those cells of `which` that are empty. A cell becomes `open`
/// if its lines do not prove that it is empty.
///
/// Neighbors cannot reveal a wrongly empty cell: both sides agree that it is absent. So emptiness has its own
/// proof.
void proveEmpty(const SiteSet& sites, std::span<const std::uint32_t> which, int threads, NeighborRows& cells);

}  // namespace vorpipe::core
