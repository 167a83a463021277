#include "motion/linear/laplacian_solver.h"

#include <algorithm>
#include <limits>
#include <new>

#include "base/block_sums.h"
#include "motion/linear/conjugate_gradients.h"
#include "motion/linear/factored.h"
#include "motion/linear/multigrid.h"
#include "motion/linear/parts.h"

namespace vorpipe::moving {
namespace {

/// Number of rows up to which factorization is about as fast as conjugate gradients (decision D110).
constexpr std::size_t most_factored = 10000;

/// Reduction by conjugate gradients before the residual is computed anew.
constexpr double at_a_time = 1e-6;

}  // namespace

struct LaplacianSolver::State {
  int threads;
  Factored factored;
  Multigrid multigrid;
  ConjugateGradients gradients;
  std::vector<double> right, residual, found, step;

  LinearSolution solve(const Laplacian& matrix, double tolerance, std::vector<double>& x);

  /// Adds to `found` the solution for `residual`. Returns the number of iterations.
  std::uint64_t improve(const Laplacian& matrix, double least);
};

std::uint64_t LaplacianSolver::State::improve(const Laplacian& matrix, double least) {
  if (matrix.rows() > most_factored) {
    return gradients.improve(matrix, multigrid, least, threads, residual, found);
  }
  factored.solve(residual, step);
  for (std::size_t i = 0; i < step.size(); ++i) found[i] += step[i];
  return 0;
}

LinearSolution LaplacianSolver::State::solve(const Laplacian& matrix, double tolerance,
                                             std::vector<double>& x) {
  const auto singular = SingularParts::of(matrix, threads);
  singular.removeMeans(right, threads);
  x.assign(right.size(), 0);
  const double norm = normOf(right, threads);
  if (!(norm > 0)) return {};
  // Single precision needs numbers near 1.
  forAll(right.size(), threads, [&](std::size_t i) { right[i] /= norm; });
  if (matrix.rows() > most_factored) {
    multigrid.build(matrix, threads);
  } else {
    factored.factor(matrix, singular);
  }
  LinearSolution solution{0, 1};
  residual = right;
  // Solves again for the residual, as long as that at least halves it.
  for (bool halved = true; halved && solution.residual > tolerance;) {
    found = x;
    // Slightly less, since the recurrence of conjugate gradients misses some rounding. Nor does it notice
    // when only rounding is left, so each call asks for a limited reduction.
    solution.iterations += improve(matrix, std::max(0.99 * tolerance, at_a_time * solution.residual));
    singular.removeMeans(found, threads);
    forAll(found.size(), threads, [&](std::size_t i) { residual[i] = right[i] - imageAt(matrix, found, i); });
    const double left = normOf(residual, threads);
    halved = left < solution.residual / 2;
    if (!(left < solution.residual)) break;
    solution.residual = left;
    x.swap(found);
    singular.removeMeans(residual, threads);
  }
  forAll(x.size(), threads, [&](std::size_t i) { x[i] *= norm; });
  return solution;
}

LaplacianSolver::LaplacianSolver(int threads) : state_(std::make_unique<State>()) {
  state_->threads = threads;
}
LaplacianSolver::LaplacianSolver(LaplacianSolver&&) noexcept = default;
LaplacianSolver& LaplacianSolver::operator=(LaplacianSolver&&) noexcept = default;
LaplacianSolver::~LaplacianSolver() = default;

Result<LinearSolution> LaplacianSolver::solve(const Laplacian& matrix, std::span<const double> b,
                                              double tolerance, std::vector<double>& x) {
  const auto failed = [](const char* why) { return tl::unexpected(Error{ErrorCode::device, why}); };
  if (matrix.columns.size() > std::numeric_limits<std::uint32_t>::max()) {
    return failed("cells have more than 4294967295 neighbors together; fewer sites would do");
  }
  try {
    state_->right.assign(b.begin(), b.end());
    return state_->solve(matrix, tolerance, x);
  } catch (const std::bad_alloc&) {
    return failed("out of memory; fewer sites would fit");
  }
}

}  // namespace vorpipe::moving
