#include "motion/linear/laplacian.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>
#include <utility>

#include "base/block_sums.h"
#include "base/disjoint_sets.h"

namespace vorpipe::moving {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Factors = Eigen::SimplicialLDLT<Matrix, Eigen::Lower>;

/// Returns one row of each singular part, that with the greatest sum of couplings: x is 0 there.
std::vector<std::size_t> heldRows(const Laplacian& matrix, const SingularParts& singular) {
  std::vector<double> greatest(singular.count(), -1);
  std::vector<std::size_t> row(singular.count());
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const auto part = singular.partOf()[i];
    if (part >= singular.count()) continue;
    double sum = 0;
    for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) sum += matrix.coupling[k];
    if (sum > greatest[part]) greatest[part] = sum, row[part] = i;
  }
  return row;
}

/// Returns the lower triangle, with the held rows replaced by those of the unit matrix.
Matrix triangleOf(const Laplacian& matrix, const std::vector<std::size_t>& held_rows) {
  std::vector<char> held(matrix.rows(), 0);
  for (const auto i : held_rows) held[i] = 1;
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

double normOf(std::span<const double> values, int threads) {
  return std::sqrt(carefulSum(values.size(), threads, [&](std::size_t i) { return values[i] * values[i]; }));
}

SingularParts::SingularParts(const Laplacian& matrix, int threads) {
  const std::size_t rows = matrix.rows();
  DisjointSets sets(rows);
  forAll(rows, threads, [&](std::size_t i) {
    for (auto k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
      if (matrix.coupling[k] > 0) sets.join(static_cast<std::uint32_t>(i), matrix.columns[k]);
    }
  });
  std::vector<char> definite(rows, 0);
  for (std::size_t i = 0; i < matrix.extra.size(); ++i) {
    if (matrix.extra[i] > 0) definite[sets.root(static_cast<std::uint32_t>(i))] = 1;
  }
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  part_of_.assign(rows, none);
  // The root of a part is its lowest row.
  for (std::size_t i = 0; i < rows; ++i) {
    const auto root = sets.root(static_cast<std::uint32_t>(i));
    if (definite[root] != 0) continue;
    if (root == i) {
      part_of_[i] = static_cast<std::uint32_t>(rows_.size());
      rows_.push_back(0);
    } else {
      part_of_[i] = part_of_[root];
    }
    ++rows_[part_of_[i]];
  }
}

void SingularParts::removeMeans(std::vector<double>& values, int threads) const {
  if (count() == 1 && rows_.front() == values.size()) {
    const double mean =
        carefulSum(values.size(), threads, [&](std::size_t i) { return values[i]; }) / rows_.front();
    forAll(values.size(), threads, [&](std::size_t i) { values[i] -= mean; });
    return;
  }
  std::vector<CarefulSum> sums(count());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (part_of_[i] < count()) sums[part_of_[i]].add(values[i]);
  }
  std::vector<double> means(count());
  for (std::size_t part = 0; part < count(); ++part) means[part] = sums[part].value() / rows_[part];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (part_of_[i] < count()) values[i] -= means[part_of_[i]];
  }
}

struct Factored::State {
  std::vector<std::size_t> held;   ///< rows where x is 0
  std::vector<int> starts, inner;  ///< the pattern that was analyzed
  std::unique_ptr<Factors> factors;
};

Factored::Factored() : state_(std::make_unique<State>()) {}
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
  const auto size = static_cast<Eigen::Index>(b.size());
  Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(b.data(), size);
  for (const std::size_t i : state_->held) right[static_cast<Eigen::Index>(i)] = 0;
  x.resize(b.size());
  Eigen::Map<Eigen::VectorXd>(x.data(), size) = state_->factors->solve(right);
}

}  // namespace vorpipe::moving
