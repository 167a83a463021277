/// Sorts distinct integers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace vorpipe {

/// Sorts distinct numbers below `end`: many of them by a bitmap, few by comparisons.
inline void sortDistinct(std::vector<std::uint32_t>& numbers, std::uint32_t end) {
  constexpr std::size_t many = 16;
  if (numbers.size() < end / many) return std::sort(numbers.begin(), numbers.end());
  std::vector<bool> is_there(end);
  for (const auto number : numbers) is_there[number] = true;
  std::size_t k = 0;
  for (std::uint32_t number = 0; number < end; ++number) {
    if (is_there[number]) numbers[k++] = number;
  }
}

}  // namespace vorpipe
