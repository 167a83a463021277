#include "moving/linear/laplacian_solver.h"

#include <cmath>
#include <new>

#include "base/block_sums.h"
#include "moving/linear/factored.h"
#include "moving/linear/parts.h"

namespace vorpipe::moving {
namespace {

double normOf(std::span<const double> values, int threads) {
  return std::sqrt(carefulSum(values.size(), threads, [&](std::size_t i) { return values[i] * values[i]; }));
}

/// b - L x, by differences of x: constants leave nothing.
void residualOf(const Laplacian& matrix, std::span<const double> b, const std::vector<double>& x, int threads,
                std::vector<double>& residual) {
  residual.resize(b.size());
  forAll(b.size(), threads, [&](std::size_t i) {
    double sum = matrix.extra.empty() ? 0 : matrix.extra[i] * x[i];
    for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
      sum += matrix.coupling[k] * (x[i] - x[matrix.columns[k]]);
    }
    residual[i] = b[i] - sum;
  });
}

}  // namespace

struct LaplacianSolver::State {
  int threads;
  Factored factored;
  std::vector<double> b, residual, step, next;

  LinearSolution solveDirectly(const Laplacian& matrix, double tolerance, std::vector<double>& x);
};

/// Solves for what is left again as long as that takes off something (iterative refinement).
LinearSolution LaplacianSolver::State::solveDirectly(const Laplacian& matrix, double tolerance,
                                                     std::vector<double>& x) {
  const auto singular = SingularParts::of(matrix, threads);
  singular.removeMeans(b);
  const double norm = normOf(b, threads);
  x.assign(b.size(), 0);
  if (!(norm > 0)) return {};
  factored.factor(matrix, singular);
  LinearSolution solution;
  solution.residual = 1;
  residual = b;
  while (solution.residual > tolerance) {
    factored.solve(residual, step);
    next.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) next[i] = x[i] + step[i];
    singular.removeMeans(next);
    residualOf(matrix, b, next, threads, residual);
    const double left = normOf(residual, threads) / norm;
    if (!(left < solution.residual)) break;
    const bool slow = left > solution.residual / 2;
    solution.residual = left;
    x.swap(next);
    if (slow) break;
    singular.removeMeans(residual);
  }
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
  try {
    state_->b.assign(b.begin(), b.end());
    return state_->solveDirectly(matrix, tolerance, x);
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error{ErrorCode::device, "out of memory; fewer sites would fit"});
  }
}

}  // namespace vorpipe::moving
