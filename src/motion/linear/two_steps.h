/// The inner iteration that turns a multigrid cycle into a K-cycle.
#pragma once

#include <functional>
#include <vector>

#include "motion/linear/level.h"

namespace vorpipe::moving {

/// Solves on a level by two steps of conjugate gradients preconditioned by cycles, or by one if it reduces
/// the residual enough (Notay and Vassilevski 2008, "Recursive Krylov-based multigrid cycles"). Unsmoothed
/// aggregates make corrections too small; optimal multiples of the cycles' results compensate for that.
class TwoSteps {
 public:
  /// `cycle` approximately solves for level.right, stores the result in level.x, and may change the right
  /// side.
  void run(Level& level, int threads, const std::function<void()>& cycle);

 private:
  void takeFirst(Level& level, int threads, double step) const;

  std::vector<float> first_;  ///< result of the first cycle
  std::vector<float> image_;  ///< the matrix times that
  std::vector<float> right_;  ///< the right side, then its residual after the first step
};

}  // namespace vorpipe::moving
