/// The matrix of a graph with weighted edges, its singular parts, and its factors.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace vorpipe::moving {

/// The derivative of cell masses with respect to weights: symmetric, and positive semidefinite. Row i has
/// -coupling[k] in column columns[k] for k from offsets[i] to offsets[i + 1] - 1. The columns are in any
/// order, never the row's own, and may repeat. The diagonal entry is the sum of these couplings and extra[i].
/// Couplings and extras are 0 or more.
struct Laplacian {
  std::vector<std::uint64_t> offsets;  ///< size: rows + 1
  std::vector<std::uint32_t> columns;
  std::vector<double> coupling;
  std::vector<double> extra;  ///< by row; empty: all 0, so that the matrix is singular

  [[nodiscard]] std::size_t rows() const { return offsets.empty() ? 0 : offsets.size() - 1; }
};

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

/// The parts whose extras are all 0, so that adding a constant there leaves the matrix product unchanged.
class SingularParts {
 public:
  SingularParts() = default;
  SingularParts(const Laplacian& matrix, int threads);

  /// Subtracts from `values` their mean over each of these parts.
  void removeMeans(std::vector<double>& values, int threads) const;

  [[nodiscard]] std::size_t count() const { return rows_.size(); }
  /// The part number of each row; count() or more if it belongs to no such part.
  [[nodiscard]] const std::vector<std::uint32_t>& partOf() const { return part_of_; }

 private:
  std::vector<std::uint32_t> part_of_;
  std::vector<std::uint32_t> rows_;  ///< by part: their number
};

/// L D L^T factors of a matrix, with columns in a minimum degree order.
class Factored {
 public:
  Factored();
  ~Factored();

  /// Factors a matrix. Reuses what depends on the pattern alone, if the pattern is that of the last matrix.
  void factor(const Laplacian& matrix, const SingularParts& singular);

  /// Finds x with L x = b. In a singular part b has the mean 0, and x is determined only up to a constant.
  void solve(std::span<const double> b, std::vector<double>& x) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::moving
