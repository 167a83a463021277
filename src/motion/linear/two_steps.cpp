#include "motion/linear/two_steps.h"

#include <array>

#include "base/block_sums.h"

namespace vorpipe::moving {
namespace {

/// Row i of the matrix times x, computed from differences, so that constants cancel exactly.
float imageAt(const Level& level, const std::vector<float>& x, std::size_t i) {
  float sum = level.extra[i] * x[i];
  for (auto k = level.offsets[i]; k < level.offsets[i + 1]; ++k) {
    sum += level.coupling[k] * (x[i] - x[level.columns[k]]);
  }
  return sum;
}

}  // namespace

void TwoSteps::takeFirst(Level& level, int threads, double step) const {
  forAll(level.rows(), threads, [&](std::size_t i) { level.x[i] = static_cast<float>(step * first_[i]); });
}

void TwoSteps::run(Level& level, int threads, const std::function<void()>& cycle) {
  const std::size_t rows = level.rows();
  right_ = level.right;
  cycle();
  first_ = level.x;
  image_.resize(rows);
  // Sums of products are in double, although the factors are not.
  using Sums = std::array<double, 3>;
  const auto [own, due, before] = sumsByBlocks<3>(rows, threads, [&](std::size_t begin, std::size_t end) {
    Sums sums{};
    for (auto i = begin; i < end; ++i) {
      image_[i] = imageAt(level, first_, i);
      const double x = first_[i], right = right_[i];
      sums[0] += x * image_[i];
      sums[1] += x * right;
      sums[2] += right * right;
    }
    return sums;
  });
  if (!(own > 0)) return;
  const double step = due / own;
  const auto [after] = sumsByBlocks<1>(rows, threads, [&](std::size_t begin, std::size_t end) {
    std::array<double, 1> sums{};
    for (auto i = begin; i < end; ++i) {
      right_[i] = static_cast<float>(right_[i] - step * image_[i]);
      sums[0] += double{right_[i]} * right_[i];
    }
    return sums;
  });
  constexpr double enough = 0.25;
  if (after < enough * enough * before) return takeFirst(level, threads, step);
  level.right = right_;
  cycle();
  const auto [own2, mixed, due2] = sumsByBlocks<3>(rows, threads, [&](std::size_t begin, std::size_t end) {
    Sums sums{};
    for (auto i = begin; i < end; ++i) {
      const double x = level.x[i];
      sums[0] += x * imageAt(level, level.x, i);
      sums[1] += x * image_[i];
      sums[2] += x * right_[i];
    }
    return sums;
  });
  // The part of the second that is conjugate to the first.
  const double rest = own2 - mixed * mixed / own;
  if (!(rest > 0)) return takeFirst(level, threads, step);
  const double step2 = due2 / rest, step1 = step - mixed * step2 / own;
  forAll(rows, threads,
         [&](std::size_t i) { level.x[i] = static_cast<float>(step1 * first_[i] + step2 * level.x[i]); });
}

}  // namespace vorpipe::moving
