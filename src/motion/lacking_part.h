/// Parts of the domain that no edge joins, as islands are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motion/linear/laplacian.h"

namespace vorpipe::moving {

/// The connected part of a graph of cells that lacks most mass.
struct LackingPart {
  std::vector<std::uint32_t> cells;  ///< empty where all cells are one part
  double lack = 0;                   ///< of all its cells together
};

LackingPart lackingPart(const Laplacian& matrix, std::span<const double> missing, int threads);

/// What these cells lack together.
double lackOf(std::span<const std::uint32_t> cells, std::span<const double> missing);

}  // namespace vorpipe::moving
