/// The largest weights in bins and blocks of bins.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace vorpipe::space {

/// The largest weight of each bin, and of each block of 2, 4, 8, ... bins along each axis, up to one of all.
class HeaviestOfBlocks {
 public:
  static constexpr double none = -std::numeric_limits<double>::infinity();

  HeaviestOfBlocks() = default;
  /// `count` is that of bins along each axis; `begin` has the first site of each bin, x first, then y.
  HeaviestOfBlocks(const int (&count)[3], std::span<const std::uint32_t> begin,
                   std::span<const double> weights);

  [[nodiscard]] std::size_t levels() const { return level_.size(); }
  [[nodiscard]] const std::array<int, 3>& count(std::size_t level) const { return level_[level].count; }
  [[nodiscard]] std::size_t indexOf(std::size_t level, const std::array<int, 3>& block) const {
    const auto& n = level_[level].count;
    return (static_cast<std::size_t>(block[2]) * static_cast<std::size_t>(n[1]) +
            static_cast<std::size_t>(block[1])) *
               static_cast<std::size_t>(n[0]) +
           static_cast<std::size_t>(block[0]);
  }
  [[nodiscard]] std::array<int, 3> blockOf(std::size_t level, std::size_t index) const {
    const auto x = static_cast<std::size_t>(level_[level].count[0]),
               y = static_cast<std::size_t>(level_[level].count[1]);
    return {static_cast<int>(index % x), static_cast<int>(index / x % y), static_cast<int>(index / x / y)};
  }
  /// The largest weight; `none` in a block without sites.
  [[nodiscard]] double at(std::size_t level, std::size_t index) const { return level_[level].most[index]; }

 private:
  struct Level {
    std::array<int, 3> count;
    std::vector<double> most;
  };
  std::vector<Level> level_;
};

/// The sites, 32 at most, that are so much heavier than all others, in bins of such a side, that cells had
/// better try each of them than look for them in bins: by descending weight.
std::vector<std::uint32_t> heavySites(std::span<const double> weights, double side);

/// By bin, the largest number of those of the bins around, up to `reach` away along each axis.
std::vector<float> largestAround(const int (&count)[3], std::vector<float> of_bin, int reach);

}  // namespace vorpipe::space
