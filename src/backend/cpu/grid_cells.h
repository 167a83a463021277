/// Cells found in float by the shared walk over the grid, as on a GPU.
#pragma once

#include <span>

#include "backend/backend.h"

namespace vorpipe::cpu {

/// Finds the neighborhoods of the sites `which`; capacity is small or large.
void findOnGrid(const SiteSet& sites, std::span<const std::uint32_t> which, Capacity capacity, int threads,
                CellNeighbors& out);

/// Finds the cells of the sites `which`, widened by outset (scaled units along x and y), and writes the
/// status of each.
void statusesOnGrid(const SiteSet& sites, std::span<const std::uint32_t> which, Capacity capacity,
                    float outset_x, float outset_y, int threads, std::span<CellStatus> status);

}  // namespace vorpipe::cpu
