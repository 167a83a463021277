/// From sites in the caller's order to unique sites in the order of their bins.
#pragma once

#include "backend/site_set.h"

namespace vorpipe::core {

/// A power of two, stored as two factors: a single one may not fit in a double.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent);
  double operator()(double value) const { return value * first_ * second_; }

 private:
  double first_, second_;
};

/// Where the bins of a set lie in a larger grid: the first column and row.
struct BlockOfGrid {
  const Grid* whole = nullptr;  ///< null: the set's grid is not part of another
  std::uint32_t west = 0, south = 0;
};

/// Fills x, y, id and grid.offsets of `set`, whose grid already has its shape. Sites are ordered by bin, row
/// by row; inside a bin by index. Of sites at equal positions the set keeps only the heaviest, of equally
/// heavy ones the lowest index; owner[i] is its index. In a block each site gets the bin that it has in the
/// whole grid; all sites are in the block's bins.
void orderByBins(const Sites& sites, const PowerOfTwo& scale, int threads, SiteSet& set,
                 std::vector<std::uint32_t>& owner, const BlockOfGrid& block = {});

}  // namespace vorpipe::core
