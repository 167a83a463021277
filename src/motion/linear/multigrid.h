/// A multigrid by aggregation (Notay 2010, "An aggregation-based algebraic multigrid method").
#pragma once

#include <cstdint>
#include <vector>

#include "motion/linear/laplacian.h"

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
  std::vector<std::uint32_t> offsets, before, behind, columns;
  std::vector<float> coupling, extra, diagonal;
  std::vector<float> inverse;  ///< of the diagonal; 0 where that is 0

  /// The row of the next level that represents this one; the rows of a block are consecutive there.
  std::vector<std::uint32_t> aggregate;

  std::vector<std::uint32_t> border;  ///< rows with couplings to other blocks
  std::vector<float> right, x;        ///< of a cycle: the right side, and the solution so far
  std::vector<float> first, image;    ///< of two steps: the result of the first, and the matrix times that
  std::vector<float> rest;            ///< the right side, then its residual after the first step

  [[nodiscard]] std::size_t rows() const { return before.size(); }
};

/// The block of a row.
inline std::size_t blockOf(std::size_t row) { return row / sweep_block; }

/// Copies a matrix in units of its greatest coupling or extra. Values too small for single precision stay
/// above 0, so that parts of the graph stay connected.
void takeMatrix(const Laplacian& matrix, int threads, Level& level);

/// Sets the aggregates of `fine`, where a coupling is strong as in findAggregates(), and the matrix of
/// `coarse` to P^T L P. P is 1 for a row of `fine` and its aggregate, else 0. So couplings between aggregates
/// are summed, and so are extras. Returns false, without a matrix, if there are almost as many aggregates as
/// rows.
bool makeCoarse(Level& fine, float strength, int threads, Level& coarse);

/// Solves a system approximately. Rows of a level are aggregated to rows of the next until few are left,
/// which are factored. Memory is reused for the next matrix.
class Multigrid {
 public:
  /// The matrix has fewer couplings than 2^32.
  void build(const Laplacian& matrix, int threads);

  /// The place for the right side, which solve() changes.
  std::vector<float>& right() { return levels_.front().right; }
  /// Solves approximately for it, up to a factor that is the same for all right sides. The result is almost,
  /// but not quite, linear in the right side.
  const std::vector<float>& solve();

 private:
  void factorCoarsest();
  void solveCoarsest();
  void cycle(std::size_t number);

  int threads_ = 1;
  std::size_t count_ = 0;  ///< of the levels that this matrix has
  std::vector<Level> levels_;

  Factored coarsest_;
  SingularParts singular_;  ///< of the coarsest level
  std::vector<double> coarsest_right_, coarsest_x_;
};

}  // namespace vorpipe::moving
