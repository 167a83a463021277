/// A multigrid by aggregation (Notay 2010, "An aggregation-based algebraic multigrid method").
#pragma once

#include <vector>

#include "motion/linear/factored.h"
#include "motion/linear/level.h"
#include "motion/linear/parts.h"
#include "motion/linear/two_steps.h"

namespace vorpipe::moving {

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
  std::vector<TwoSteps> steps_;  ///< by level

  Factored coarsest_;
  SingularParts singular_;  ///< of the coarsest level
  std::vector<double> coarsest_right_, coarsest_x_;
};

}  // namespace vorpipe::moving
