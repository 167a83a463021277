/// Conjugate gradients, preconditioned by a multigrid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motion/linear/laplacian.h"
#include "motion/linear/multigrid.h"

namespace vorpipe::moving {

/// Row i of the matrix times x, computed from differences, so that constants cancel exactly.
inline double imageAt(const Laplacian& matrix, const std::vector<double>& x, std::size_t i) {
  double sum = matrix.extra.empty() ? 0 : matrix.extra[i] * x[i];
  for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
    sum += matrix.coupling[k] * (x[i] - x[matrix.columns[k]]);
  }
  return sum;
}

/// The root of the sum of squares.
double normOf(std::span<const double> values, int threads);

/// The form that allows a nonlinear preconditioner (Notay 2000, "Flexible conjugate gradients").
class ConjugateGradients {
 public:
  /// Adds to x an approximate solution of L d = r and updates the residual r, up to the recurrence's
  /// rounding. Ends at |r| <= least, or when it makes no more progress. Returns the number of iterations.
  std::uint64_t improve(const Laplacian& matrix, Multigrid& multigrid, double least, int threads,
                        std::vector<double>& r, std::vector<double>& x);

 private:
  std::vector<double> direction_, image_;
};

}  // namespace vorpipe::moving
