/// The largest weights in the bins of a grid and in blocks of bins: Grid::heaviest.
#pragma once

#include "sites/grid.h"

namespace vorpipe::core {

/// Fills grid.heaviest with a value for each bin, from the weights of its sites.
void noteHeaviest(SiteSet& sites, int threads);

/// Adds the pyramid above the values of the bins.
void buildPyramid(Grid& grid);

/// The largest weight in a block of bins.
double heaviestIn(const Grid& grid, const BinBlock& block);

/// Accounts for the sites of a set outside a part whose bins hold only those of the block `of`. Raises each
/// bin of the part that may stand for a site beyond a side of part.coverage to the largest weight there.
/// Needs the bins' values in part.grid.heaviest; call buildPyramid afterwards.
void countBeyond(const SiteSet& set, const BinBlock& of, SiteSet& part);

}  // namespace vorpipe::core
