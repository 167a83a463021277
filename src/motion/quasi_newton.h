/// Directions of the quasi-Newton method L-BFGS (Nocedal 1980), as Liu et al. 2009 use it for relaxation.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace vorpipe::moving {

/// The last few steps, and how the gradient changed in them. All vectors are as long as the first one.
class QuasiNewton {
 public:
  /// How many steps are kept: 20 gained nothing over 7.
  static constexpr std::size_t memory = 7;

  explicit QuasiNewton(int threads) : threads_(threads) {}

  /// Keeps a step and the change of the gradient in it, where the energy curves upward along it.
  void add(std::vector<double> step, std::vector<double> change);
  void clear() { pairs_.clear(); }
  [[nodiscard]] bool empty() const { return pairs_.empty(); }

  /// Replaces `direction` by that of descent. `inverse` is the diagonal of the inverse Hessian's first guess;
  /// without pairs the direction is minus `inverse` times `gradient`.
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
