#include "motion/linear/conjugate_gradients.h"

#include <array>
#include <cmath>
#include <limits>

#include "base/block_sums.h"

namespace vorpipe::moving {

double normOf(std::span<const double> values, int threads) {
  return std::sqrt(carefulSum(values.size(), threads, [&](std::size_t i) { return values[i] * values[i]; }));
}

std::uint64_t ConjugateGradients::improve(const Laplacian& matrix, Multigrid& multigrid, double least,
                                          int threads, std::vector<double>& r, std::vector<double>& x) {
  // Number of iterations in which the least residual so far must halve: hundreds if a multigrid fits badly.
  constexpr std::uint64_t patience = 100;
  const std::size_t size = x.size();
  direction_.assign(size, 0);
  image_.assign(size, 0);
  double step = 0, due_before = 1, halved = std::numeric_limits<double>::infinity();
  std::uint64_t iteration = 0, halved_at = 0;
  for (;;) {
    auto& right = multigrid.right();
    forAll(size, threads, [&](std::size_t i) { right[i] = static_cast<float>(r[i]); });
    const auto& z = multigrid.solve();
    const auto [due, mixed] = sumsByBlocks<2>(size, threads, [&](std::size_t begin, std::size_t end) {
      std::array<double, 2> sums{};
      for (auto i = begin; i < end; ++i) {
        sums[0] += r[i] * z[i];
        sums[1] += image_[i] * z[i];
      }
      return sums;
    });
    if (!(due > 0)) return iteration;
    // (r - r_before) . z / due_before, where r - r_before is -step times the image.
    const double beta = -step * mixed / due_before;
    due_before = due;
    forAll(size, threads, [&](std::size_t i) { direction_[i] = z[i] + beta * direction_[i]; });
    const auto [own] = sumsByBlocks<1>(size, threads, [&](std::size_t begin, std::size_t end) {
      std::array<double, 1> sums{};
      for (auto i = begin; i < end; ++i) {
        image_[i] = imageAt(matrix, direction_, i);
        sums[0] += direction_[i] * image_[i];
      }
      return sums;
    });
    if (!(own > 0)) return iteration;
    step = due / own;
    const auto [squares] = sumsByBlocks<1>(size, threads, [&](std::size_t begin, std::size_t end) {
      std::array<double, 1> sums{};
      for (auto i = begin; i < end; ++i) {
        x[i] += step * direction_[i];
        r[i] -= step * image_[i];
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

}  // namespace vorpipe::moving
