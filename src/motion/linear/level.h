/// One of the matrices of a multigrid, as sweeps go through it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace vorpipe::moving {

/// Rows that a sweep goes through one after the other. What belongs to other blocks is taken as it was before
/// the sweep, so that nothing depends on how many threads there are, each of which takes a block at a time.
inline constexpr std::size_t sweep_block = 16384;

/// Stands where a row has no aggregate.
inline constexpr std::uint32_t no_aggregate = 0xFFFFFFFFu;

/// A matrix as Laplacian, in single precision. The diagonal is the sum of what was rounded: so rounding
/// leaves it a matrix of a graph, and changes x . L x by 1e-7 of itself, however small that is beside the
/// couplings.
struct Level {
  /// In row i couplings come first to rows of other blocks, then, from before[i] on, to rows of the same
  /// block before i, then, from behind[i] on, to those behind i.
  std::vector<std::uint32_t> offsets, before, behind;
  std::vector<std::uint32_t> columns;
  std::vector<float> coupling;
  std::vector<float> extra;
  std::vector<float> diagonal;
  std::vector<float> inverse;  ///< of the diagonal; 0 where that is 0

  /// The row of the next level that stands for this one; those of a block are consecutive there.
  std::vector<std::uint32_t> aggregate;

  std::vector<std::uint32_t> border;  ///< rows with couplings to other blocks
  std::vector<float> right, x;        ///< of a cycle: the right side, and what solves it so far

  [[nodiscard]] std::size_t rows() const { return before.size(); }
};

/// Sets the border of a level that has its couplings.
void findBorder(Level& level);

/// The block of a row.
inline std::size_t blockOf(std::size_t row) { return row / sweep_block; }

/// Counts become the places where what was counted begins; the last one becomes the sum.
inline void becomePlaces(std::vector<std::uint32_t>& counts) {
  std::uint32_t sum = 0;
  for (auto& count : counts) {
    const auto here = count;
    count = sum;
    sum += here;
  }
}

}  // namespace vorpipe::moving
