/// What makes a cycle of a multigrid a K-cycle.
#pragma once

#include <functional>
#include <vector>

#include "motion/linear/level.h"

namespace vorpipe::moving {

/// Solves on a level by two steps of conjugate gradients that cycles precondition, or by one where that takes
/// off enough (Notay and Vassilevski 2008, "Recursive Krylov-based multigrid cycles"). The best multiples of
/// what cycles find make up for the corrections that aggregates without smoothing make too small.
class TwoSteps {
 public:
  /// `cycle` solves approximately for level.right, in level.x, and may change the right side.
  void run(Level& level, int threads, const std::function<void()>& cycle);

 private:
  void takeFirst(Level& level, int threads, double step) const;

  std::vector<float> first_;  ///< what the first cycle found
  std::vector<float> image_;  ///< the matrix times that
  std::vector<float> right_;  ///< the right side, then what the first step leaves of it
};

}  // namespace vorpipe::moving
