/// The matrix of a graph with weighted edges: the derivative of cell masses with respect to weights.
#pragma once

#include <cstdint>
#include <vector>

namespace vorpipe::moving {

/// Symmetric, and positive semidefinite. Row i has -coupling[k] in column columns[k] for k from offsets[i] to
/// offsets[i + 1] - 1. The columns are in any order, never the row's own, and may repeat. The diagonal entry
/// is the sum of these couplings and extra[i]. Couplings and extras are 0 or more.
struct Laplacian {
  std::vector<std::uint64_t> offsets;  ///< size: rows + 1
  std::vector<std::uint32_t> columns;
  std::vector<double> coupling;
  std::vector<double> extra;  ///< by row; empty: all 0, so that the matrix is singular

  [[nodiscard]] std::size_t rows() const { return offsets.empty() ? 0 : offsets.size() - 1; }
};

}  // namespace vorpipe::moving
