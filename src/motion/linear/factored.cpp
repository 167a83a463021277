#include "motion/linear/factored.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <utility>

namespace vorpipe::moving {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Factors = Eigen::SimplicialLDLT<Matrix, Eigen::Lower>;

/// Marks one row of each singular part, that with the greatest sum of couplings: x is 0 there.
std::vector<char> heldRows(const Laplacian& matrix, const SingularParts& singular) {
  std::vector<double> greatest(singular.count(), -1);
  std::vector<std::size_t> row(singular.count());
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const auto part = singular.partOf()[i];
    if (part >= singular.count()) continue;
    double sum = 0;
    for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) sum += matrix.coupling[k];
    if (sum > greatest[part]) greatest[part] = sum, row[part] = i;
  }
  std::vector<char> held(matrix.rows(), 0);
  for (const auto i : row) held[i] = 1;
  return held;
}

/// Returns the lower triangle, with the held rows replaced by those of the unit matrix.
Matrix triangleOf(const Laplacian& matrix, const std::vector<char>& held) {
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(matrix.columns.size() / 2 + matrix.rows());
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const int column = static_cast<int>(i);
    double sum = matrix.extra.empty() ? 0 : matrix.extra[i];
    for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
      const auto j = matrix.columns[k];
      sum += matrix.coupling[k];
      if (j > i && held[i] == 0 && held[j] == 0) {
        entries.emplace_back(static_cast<int>(j), column, -matrix.coupling[k]);
      }
    }
    entries.emplace_back(column, column, held[i] != 0 ? 1 : sum);
  }
  const auto rows = static_cast<Eigen::Index>(matrix.rows());
  Matrix triangle(rows, rows);
  triangle.setFromTriplets(entries.begin(), entries.end());
  return triangle;
}

}  // namespace

struct Factored::State {
  std::vector<char> held;
  std::vector<int> starts, inner;  ///< the pattern that was analyzed
  std::unique_ptr<Factors> factors;
};

Factored::Factored() : state_(std::make_unique<State>()) {}
Factored::Factored(Factored&&) noexcept = default;
Factored& Factored::operator=(Factored&&) noexcept = default;
Factored::~Factored() = default;

void Factored::factor(const Laplacian& matrix, const SingularParts& singular) {
  auto& state = *state_;
  state.held = heldRows(matrix, singular);
  const Matrix triangle = triangleOf(matrix, state.held);
  std::vector<int> starts(triangle.outerIndexPtr(), triangle.outerIndexPtr() + triangle.outerSize() + 1);
  std::vector<int> inner(triangle.innerIndexPtr(), triangle.innerIndexPtr() + triangle.nonZeros());
  if (starts != state.starts || inner != state.inner || state.factors == nullptr) {
    // When arrays of Eigen 3.4 change their size, they free their memory first. If there is no memory for
    // more, they free it again at the end. Arrays of new factors have none.
    auto factors = std::make_unique<Factors>();
    factors->analyzePattern(triangle);
    state.factors = std::move(factors);
    state.starts = std::move(starts);
    state.inner = std::move(inner);
  }
  state.factors->factorize(triangle);
}

void Factored::solve(std::span<const double> b, std::vector<double>& x) const {
  const auto& state = *state_;
  Eigen::VectorXd right(static_cast<Eigen::Index>(b.size()));
  for (std::size_t i = 0; i < b.size(); ++i) right[static_cast<Eigen::Index>(i)] = state.held[i] ? 0 : b[i];
  const Eigen::VectorXd found = state.factors->solve(right);
  x.assign(found.data(), found.data() + found.size());
}

}  // namespace vorpipe::moving
