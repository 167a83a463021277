/// The edges of cells in a box, as solvers ask for them.
#pragma once

#include "core/moving/box_moments.h"

namespace vorpipe::core {

/// Of cells that findMoments() found, in the order of `meet`, which neighborsOf() made of them.
EdgesOfCells edgesOf(const FoundBox& found, const CellsThatMeet& meet, int threads);

}  // namespace vorpipe::core
