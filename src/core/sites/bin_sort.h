/// From sites in the caller's order to unique sites in the order of their bins.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// A factor that is a power of two, as two factors: one alone may not be a double.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent);
  double operator()(double value) const { return value * first_ * second_; }

 private:
  double first_, second_;
};

/// Fills x, y, id and grid.offsets of `set`, whose grid has its shape: sites bin by bin, rows first, inside
/// a bin by index. Of equal positions only the heaviest site is in the set, of equally heavy ones the lowest
/// index; owner[i] is its index.
void orderByBins(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
                 std::vector<std::uint32_t>& owner);

}  // namespace vorpipe::core
