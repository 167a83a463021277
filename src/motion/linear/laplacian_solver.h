/// Solves the linear systems of Newton's method for masses.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "motion/linear/laplacian.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// How a system was solved.
struct LinearSolution {
  std::uint64_t iterations = 0;  ///< of conjugate gradients; 0: solved directly
  double residual = 0;           ///< |b - L x| / |b|, computed from x
};

/// Reuses memory between systems. Results do not depend on the number of threads.
class LaplacianSolver {
 public:
  explicit LaplacianSolver(int threads);
  ~LaplacianSolver();

  /// Finds x with |b - L x| <= tolerance |b|. In each connected part of the graph whose extras are all 0, b's
  /// mean over the part is subtracted, and x has the mean 0. Rows of neighbors are best near each other. If
  /// rounding prevents the tolerance, the residual is as small as rounding allows; the solution reports it.
  /// Error (device): out of memory.
  Result<LinearSolution> solve(const Laplacian& matrix, std::span<const double> b, double tolerance,
                               std::vector<double>& x);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::moving
