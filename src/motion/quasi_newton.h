/// Search directions of the quasi-Newton method L-BFGS (Nocedal 1980), used for relaxation as in Liu et al.
/// 2009.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace vorpipe::moving {

/// Keeps the last few steps and their changes of the gradient. All vectors are as long as the first one.
class QuasiNewton {
 public:
  /// Number of steps kept: 20 gained nothing over 7.
  static constexpr std::size_t memory = 7;

  explicit QuasiNewton(int threads) : threads_(threads) {}

  /// Keeps a step and its change of the gradient, if the energy curves upward along the step.
  void add(std::vector<double> step, std::vector<double> change);
  void clear() { pairs_.clear(); }
  [[nodiscard]] bool empty() const { return pairs_.empty(); }

  /// Sets `direction` to the descent direction. `inverse` is the diagonal of the initial inverse Hessian.
  /// Without pairs the direction is minus `inverse` times `gradient`.
  void direction(const std::vector<double>& gradient, const std::vector<double>& inverse,
                 std::vector<double>& direction) const;

 private:
  struct Pair {
    std::vector<double> step, change;
  };
  struct Products;
  [[nodiscard]] Products productsOf(const std::vector<double>& gradient,
                                    const std::vector<double>& inverse) const;

  int threads_;
  std::deque<Pair> pairs_;  ///< the oldest first
};

}  // namespace vorpipe::moving
