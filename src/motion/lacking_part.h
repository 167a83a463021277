/// Parts of the domain not joined by any edge, such as islands.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motion/linear/laplacian.h"

namespace vorpipe::moving {

/// The connected part of a graph of cells that lacks the most mass.
struct LackingPart {
  std::vector<std::uint32_t> cells;  ///< empty where all cells are one part
  double lack = 0;                   ///< total of its cells
};

LackingPart lackingPart(const Laplacian& matrix, std::span<const double> missing, int threads);

/// Returns the total mass that these cells lack.
double lackOf(std::span<const std::uint32_t> cells, std::span<const double> missing);

}  // namespace vorpipe::moving
