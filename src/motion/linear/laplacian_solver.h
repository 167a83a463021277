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
  double residual = 0;           ///< |b - L x| / |b|, which was computed from x
};

/// Keeps memory from one system to the next. Results do not depend on the number of threads.
class LaplacianSolver {
 public:
  explicit LaplacianSolver(int threads);
  LaplacianSolver(LaplacianSolver&&) noexcept;
  LaplacianSolver& operator=(LaplacianSolver&&) noexcept;
  ~LaplacianSolver();

  /// Finds x with |b - L x| <= tolerance |b|. In each connected part of the graph whose extras are all 0, b's
  /// mean over the part is taken from it and x has the mean 0. Rows are best in an order in which those of
  /// neighbors are near each other. What rounding allows is reached where that is less than was asked for;
  /// the solution says so. Error (device): out of memory.
  Result<LinearSolution> solve(const Laplacian& matrix, std::span<const double> b, double tolerance,
                               std::vector<double>& x);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::moving
