/// From sites in the caller's order to unique sites in the order of their bins.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

/// A factor that is a power of two, as two factors: one alone may not be a double.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent);
  double operator()(double value) const { return value * first_ * second_; }

 private:
  double first_, second_;
};

/// Fills x, y, id and grid.first of `set`, whose grid has its shape: sites bin by bin, rows first, inside
/// a bin by index. Of equal positions only the lowest index is in the set; owner[i] is that index.
void orderByBins(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
                 std::vector<std::uint32_t>& owner);

}  // namespace vorpipe
