#include "motion/quasi_newton.h"

#include <array>
#include <utility>

#include "base/block_sums.h"

namespace vorpipe::moving {
namespace {

constexpr std::size_t most = QuasiNewton::memory;

/// Four independent sums, which a compiler may vectorize.
double dot(const double* a, const double* b, std::size_t count) {
  std::array<double, 4> sum{};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
  }
  for (; i < count; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace

/// All products that the two loops of the method need. The loops then run over numbers instead of vectors,
/// and each vector is read only once.
struct QuasiNewton::Products {
  std::array<double, most> step_gradient{};             ///< s_i . g
  std::array<double, most> change_gradient{};           ///< y_i . D g
  std::array<std::array<double, most>, most> mixed{};   ///< s_i . y_j
  std::array<std::array<double, most>, most> change{};  ///< y_i . D y_j

  void add(const Products& other) {
    for (std::size_t i = 0; i < most; ++i) {
      step_gradient[i] += other.step_gradient[i];
      change_gradient[i] += other.change_gradient[i];
      for (std::size_t j = 0; j < most; ++j) {
        mixed[i][j] += other.mixed[i][j];
        change[i][j] += other.change[i][j];
      }
    }
  }
};

void QuasiNewton::add(std::vector<double> step, std::vector<double> change) {
  const double curvature =
      carefulSum(step.size(), threads_, [&](std::size_t i) { return step[i] * change[i]; });
  if (!(curvature > 0)) return;
  if (pairs_.size() == memory) pairs_.pop_front();
  pairs_.push_back({std::move(step), std::move(change)});
}

QuasiNewton::Products QuasiNewton::productsOf(const std::vector<double>& gradient,
                                              const std::vector<double>& inverse) const {
  const std::size_t kept = pairs_.size();
  const auto parts = byBlocks<Products>(gradient.size(), threads_, [&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    std::array<double, sum_block> scaled;
    Products part;
    for (std::size_t i = 0; i < kept; ++i) {
      const double* const change = pairs_[i].change.data() + begin;
      for (std::size_t k = 0; k < count; ++k) scaled[k] = inverse[begin + k] * change[k];
      part.step_gradient[i] = dot(pairs_[i].step.data() + begin, gradient.data() + begin, count);
      part.change_gradient[i] = dot(scaled.data(), gradient.data() + begin, count);
      for (std::size_t j = 0; j < kept; ++j) {
        part.mixed[j][i] = dot(pairs_[j].step.data() + begin, change, count);
        if (j <= i)
          part.change[i][j] = part.change[j][i] = dot(scaled.data(), pairs_[j].change.data() + begin, count);
      }
    }
    return part;
  });
  Products sum;
  for (const Products& part : parts) sum.add(part);
  return sum;
}

void QuasiNewton::direction(const std::vector<double>& gradient, const std::vector<double>& inverse,
                            std::vector<double>& direction) const {
  const std::size_t kept = pairs_.size();
  const Products of = productsOf(gradient, inverse);
  // The result is minus: scale D (g - sum of alpha_i y_i) + sum of (alpha_i - beta_i) s_i.
  std::array<double, most> alpha{}, beta{};
  for (std::size_t i = kept; i-- > 0;) {
    double product = of.step_gradient[i];
    for (std::size_t j = i + 1; j < kept; ++j) product -= alpha[j] * of.mixed[i][j];
    alpha[i] = product / of.mixed[i][i];
  }
  const std::size_t last = kept - 1;
  const double scale = kept == 0 ? 1 : of.mixed[last][last] / of.change[last][last];
  for (std::size_t i = 0; i < kept; ++i) {
    double product = of.change_gradient[i];
    for (std::size_t j = 0; j < kept; ++j) product -= alpha[j] * of.change[i][j];
    product *= scale;
    for (std::size_t j = 0; j < i; ++j) product += (alpha[j] - beta[j]) * of.mixed[j][i];
    beta[i] = product / of.mixed[i][i];
  }
  direction.resize(gradient.size());
  forAll(gradient.size(), threads_, [&](std::size_t k) {
    double rest = gradient[k], along = 0;
    for (std::size_t i = 0; i < kept; ++i) {
      rest -= alpha[i] * pairs_[i].change[k];
      along += (alpha[i] - beta[i]) * pairs_[i].step[k];
    }
    direction[k] = -(scale * inverse[k] * rest + along);
  });
}

}  // namespace vorpipe::moving
