/// From sites in the caller's order to unique sites in the order of their bins.
#pragma once

#include <cmath>

#include "backend/backend.h"

namespace vorpipe {

/// Scaled coordinates nearer to 0 are 0: exact decisions multiply four differences, of which a double could
/// not hold enough.
inline constexpr double least_coordinate = 0x1p-200;

/// A factor that is a power of two, as two factors: one alone may not be a double.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent);
  double operator()(double value) const { return value * first_ * second_; }
  /// The same of a site's coordinate.
  [[nodiscard]] double coordinate(double value) const {
    const double scaled = (*this)(value);
    return std::abs(scaled) < least_coordinate ? 0 : scaled;
  }

 private:
  double first_, second_;
};

/// Fills x, y, id and grid.first of `set`, whose grid has its shape: sites bin by bin, rows first, inside
/// a bin by index. Of equal positions only the heaviest site is in the set, of equally heavy ones the lowest
/// index; owner[i] is its index.
void orderByBins(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
                 std::vector<std::uint32_t>& owner);

}  // namespace vorpipe
