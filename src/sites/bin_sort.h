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

/// Which bins of a larger grid the bins of a set are: those from a column and a row on.
struct BlockOfGrid {
  const Grid* whole = nullptr;  ///< null: the set's grid is no part of another
  std::uint32_t west = 0, south = 0;
};

/// Fills x, y, id and grid.offsets of `set`, whose grid has its shape: sites bin by bin, rows first, inside
/// a bin by index. Of equal positions only the heaviest site is in the set, of equally heavy ones the lowest
/// index; owner[i] is its index. In a block each site, all of which are in its bins, gets the bin that it has
/// in the whole grid.
void orderByBins(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
                 std::vector<std::uint32_t>& owner, const BlockOfGrid& block = {});

}  // namespace vorpipe::core
