/// Solves a system by factorization of its matrix.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "motion/linear/laplacian.h"
#include "motion/linear/parts.h"

namespace vorpipe::moving {

/// L D L^T factors of a matrix, with columns in a minimum degree order.
class Factored {
 public:
  Factored();
  Factored(Factored&&) noexcept;
  Factored& operator=(Factored&&) noexcept;
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
