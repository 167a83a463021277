#include "motion/misfit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/block_sums.h"

namespace vorpipe::moving {

Misfit misfitOf(const CellMoments& moments, std::span<const double> targets, Surface surface, int threads,
                std::vector<double>& missing) {
  const std::size_t count = targets.size();
  missing.resize(count);
  double scale = 1, mean = 0;
  if (surface == Surface::none) {
    const double sum = carefulSum(count, threads, [&](std::size_t i) { return moments.mass[i]; });
    scale = sum / carefulSum(count, threads, [&](std::size_t i) { return targets[i]; });
    const double gap =
        carefulSum(count, threads, [&](std::size_t i) { return scale * targets[i] - moments.mass[i]; });
    mean = gap / static_cast<double>(count);
  }
  struct Part {
    CarefulSum squares;
    double worst = 0, least = std::numeric_limits<double>::infinity();
  };
  const auto parts = byBlocks<Part>(count, threads, [&](std::size_t begin, std::size_t end) {
    Part part;
    for (auto i = begin; i < end; ++i) {
      const double target = scale * targets[i];
      missing[i] = target - moments.mass[i] - mean;
      part.squares.add(missing[i] * missing[i]);
      part.worst = std::max(part.worst, std::abs(missing[i]) / target);
      part.least = std::min(part.least, moments.mass[i] / target);
    }
    return part;
  });
  Part all;
  for (const Part& part : parts) {
    all.squares.add(part.squares.value());
    all.worst = std::max(all.worst, part.worst);
    all.least = std::min(all.least, part.least);
  }
  return {std::sqrt(all.squares.value()), all.worst, all.least};
}

}  // namespace vorpipe::moving
