#include "motion/linear/laplacian_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>

#include "base/block_sums.h"
#include "motion/linear/multigrid.h"

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
  std::vector<double> right, residual, found, step;
  std::vector<double> direction, image;  ///< of conjugate gradients

  LinearSolution solve(const Laplacian& matrix, double tolerance, std::vector<double>& x);

  std::uint64_t improve(const Laplacian& matrix, double least);
  std::uint64_t improveByGradients(const Laplacian& matrix, double least);
};

/// Adds to `found` the solution for `residual`. Returns the number of iterations.
std::uint64_t LaplacianSolver::State::improve(const Laplacian& matrix, double least) {
  if (matrix.rows() > most_factored) return improveByGradients(matrix, least);
  factored.solve(residual, step);
  for (std::size_t i = 0; i < step.size(); ++i) found[i] += step[i];
  return 0;
}

/// Adds to `found` an approximate solution for `residual`, and updates the residual, up to the recurrence's
/// rounding. Ends at |residual| <= least, or when it makes no more progress. Returns the number of
/// iterations. These conjugate gradients allow a nonlinear preconditioner (Notay 2000, "Flexible conjugate
/// gradients").
std::uint64_t LaplacianSolver::State::improveByGradients(const Laplacian& matrix, double least) {
  // Number of iterations in which the least residual so far must halve: hundreds if a multigrid fits badly.
  constexpr std::uint64_t patience = 100;
  auto &r = residual, &x = found;
  const std::size_t size = x.size();
  direction.assign(size, 0);
  image.assign(size, 0);
  double length = 0, due_before = 1, halved = std::numeric_limits<double>::infinity();
  std::uint64_t iteration = 0, halved_at = 0;
  for (;;) {
    auto& to_solve = multigrid.right();
    forAll(size, threads, [&](std::size_t i) { to_solve[i] = static_cast<float>(r[i]); });
    const auto& z = multigrid.solve();
    const auto [due, mixed] = sumsByBlocks<2>(size, threads, [&](std::size_t begin, std::size_t end) {
      std::array<double, 2> sums{};
      for (auto i = begin; i < end; ++i) {
        sums[0] += r[i] * z[i];
        sums[1] += image[i] * z[i];
      }
      return sums;
    });
    if (!(due > 0)) return iteration;
    // (r - r_before) . z / due_before, where r - r_before is -length times the image.
    const double beta = -length * mixed / due_before;
    due_before = due;
    forAll(size, threads, [&](std::size_t i) { direction[i] = z[i] + beta * direction[i]; });
    const auto [own] = sumsByBlocks<1>(size, threads, [&](std::size_t begin, std::size_t end) {
      std::array<double, 1> sums{};
      for (auto i = begin; i < end; ++i) {
        image[i] = imageAt(matrix, direction, i);
        sums[0] += direction[i] * image[i];
      }
      return sums;
    });
    if (!(own > 0)) return iteration;
    length = due / own;
    const auto [squares] = sumsByBlocks<1>(size, threads, [&](std::size_t begin, std::size_t end) {
      std::array<double, 1> sums{};
      for (auto i = begin; i < end; ++i) {
        x[i] += length * direction[i];
        r[i] -= length * image[i];
        sums[0] += r[i] * r[i];
      }
      return sums;
    });
    ++iteration;
    const double norm = std::sqrt(squares);
    if (!(norm > least)) return iteration;
    if (norm <= halved / 2) {
      halved = norm;
      halved_at = iteration;
    } else if (iteration - halved_at >= patience) {
      return iteration;
    }
  }
}

LinearSolution LaplacianSolver::State::solve(const Laplacian& matrix, double tolerance,
                                             std::vector<double>& x) {
  const SingularParts singular(matrix, threads);
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
