/// The largest weights in the bins of a grid and in blocks of bins: Grid::heaviest.
#pragma once

#include "core/sites/grid.h"

namespace vorpipe::core {

/// Fills grid.heaviest with the number of each bin, from the weights of its sites.
void noteHeaviest(SiteSet& sites, int threads);

/// Adds the pyramid above the numbers of the bins.
void buildPyramid(Grid& grid);

/// The largest weight in a block of bins.
double heaviestIn(const Grid& grid, const BinBlock& block);

/// Counts in a part of a set what the part does not know, for its bins have `of` alone, a block of the
/// set's: a site beyond one side of part.coverage, heavier than all there, in each bin that such a site may
/// stand in. part.grid.heaviest has the numbers of the bins; the pyramid is to be made after this.
void countBeyond(const SiteSet& set, const BinBlock& of, SiteSet& part);

}  // namespace vorpipe::core
