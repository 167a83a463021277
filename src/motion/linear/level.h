/// One of the matrices of a multigrid, in the layout that sweeps use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace vorpipe::moving {

/// Number of rows that a sweep processes sequentially. It uses values of other blocks from before the sweep.
/// So results do not depend on the number of threads, which take a block at a time each.
inline constexpr std::size_t sweep_block = 16384;

/// Marks a row without an aggregate.
inline constexpr std::uint32_t no_aggregate = 0xFFFFFFFFu;

/// A matrix like Laplacian, in single precision. The diagonal is the sum of the rounded values. So the
/// rounded matrix is still that of a graph, and x . L x changes by a relative 1e-7 only, however small it is
/// beside the couplings.
struct Level {
  /// In row i, couplings to rows of other blocks come first. Those to rows of the same block before i begin
  /// at before[i], those to rows behind i at behind[i].
  std::vector<std::uint32_t> offsets, before, behind;
  std::vector<std::uint32_t> columns;
  std::vector<float> coupling;
  std::vector<float> extra;
  std::vector<float> diagonal;
  std::vector<float> inverse;  ///< of the diagonal; 0 where that is 0

  /// The row of the next level that represents this one; the rows of a block are consecutive there.
  std::vector<std::uint32_t> aggregate;

  std::vector<std::uint32_t> border;  ///< rows with couplings to other blocks
  std::vector<float> right, x;        ///< of a cycle: the right side, and the solution so far

  [[nodiscard]] std::size_t rows() const { return before.size(); }
};

/// Sets the border of a level whose couplings are set.
void findBorder(Level& level);

/// The block of a row.
inline std::size_t blockOf(std::size_t row) { return row / sweep_block; }

/// Turns counts into start offsets; the last one becomes the sum.
inline void becomePlaces(std::vector<std::uint32_t>& counts) {
  std::uint32_t sum = 0;
  for (auto& count : counts) {
    const auto here = count;
    count = sum;
    sum += here;
  }
}

}  // namespace vorpipe::moving
