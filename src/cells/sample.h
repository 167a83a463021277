/// Cells tried first, to predict how a device does on the others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace vorpipe::core {

struct Sample {
  std::vector<std::uint32_t> cells, rest;  ///< together `which`, both ascending

  /// All of `which`, if it is too short to be worth a sample; else some hundred, evenly spread.
  explicit Sample(std::span<const std::uint32_t> which) {
    constexpr std::size_t size = 128, least = 8 * size;
    const auto step = which.size() < least ? 1 : which.size() / size;
    cells.reserve(which.size() / step + 1);
    rest.reserve(which.size() - which.size() / step);
    for (std::size_t begin = 0; begin < which.size(); begin += step) {
      const auto some = which.subspan(begin, std::min(step, which.size() - begin));
      cells.push_back(some.front());
      rest.insert(rest.end(), some.begin() + 1, some.end());
    }
  }

  /// Estimates, rather too low, how many of the rest will fail if `failed` of the sample did.
  [[nodiscard]] std::size_t expected(std::size_t failed) const {
    return failed * rest.size() / cells.size() / 2;
  }

  /// Whether so few of the rest will succeed that the judge finds all of them sooner than a device tries
  /// them.
  [[nodiscard]] bool isHopeless(std::size_t failed) const { return 4 * failed > 3 * cells.size(); }

  /// Whether weights hide so many sites, given `hidden` in the sample, that triangulating all sites is
  /// faster. A triangulation drops a hidden site at once; a device must look far around it for a heavier one.
  [[nodiscard]] bool areMostlyHidden(std::size_t hidden) const { return 3 * hidden > cells.size(); }
};

}  // namespace vorpipe::core
