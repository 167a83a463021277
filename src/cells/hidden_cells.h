/// Proofs that cells are empty: sites with weights hide others (decision D74).
#pragma once

#include <span>

#include "cells/neighbor_rows.h"

namespace vorpipe::core {

/// Whether the bisectors of `cell` with the sites among `lines` leave nothing of the domain that has an area.
/// Exact, but for coordinates of the range that predicates.h names; beyond it the answer is no.
bool leaveNothing(const SiteSet& sites, std::uint32_t cell, std::span<const std::int32_t> lines);

/// Takes the lines from those cells of `which` that are empty in a set with weights; where they do not prove
/// that, the cell becomes `open`.
///
/// Neighbors cannot reveal a wrongly empty cell: both sides agree that it is absent. So emptiness has its own
/// proof.
void proveEmpty(const SiteSet& sites, std::span<const std::uint32_t> which, int threads, NeighborRows& cells);

}  // namespace vorpipe::core
