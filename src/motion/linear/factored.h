/// Solves a system by factors of its matrix.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "motion/linear/laplacian.h"
#include "motion/linear/parts.h"

namespace vorpipe::moving {

/// L D L^T of a matrix, with columns in an order of least degree.
class Factored {
 public:
  Factored();
  Factored(Factored&&) noexcept;
  Factored& operator=(Factored&&) noexcept;
  ~Factored();

  /// What depends on the pattern alone is kept, where this one is that of the matrix before.
  void factor(const Laplacian& matrix, const SingularParts& singular);

  /// Finds x with L x = b. In a singular part b has the mean 0, and of x a constant is not determined.
  void solve(std::span<const double> b, std::vector<double>& x) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::moving
