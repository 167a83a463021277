/// The largest weights in the bins of a grid and in blocks of bins: Grid::heaviest.
#pragma once

#include "sites/grid.h"

namespace vorpipe::core {

/// Fills grid.heaviest with the number of each bin, from the weights of its sites.
void noteHeaviest(SiteSet& sites, int threads);

/// Adds the pyramid above the numbers of the bins.
void buildPyramid(Grid& grid);

/// The largest weight in a block of bins.
double heaviestIn(const Grid& grid, const BinBlock& block);

/// Accounts for the sites of a set that are outside of a part, whose bins hold those of the block `of` alone:
/// raises each bin of the part that may stand for a site beyond a side of part.coverage to the largest weight
/// there. Needs the bins' numbers in part.grid.heaviest; buildPyramid comes after this.
void countBeyond(const SiteSet& set, const BinBlock& of, SiteSet& part);

}  // namespace vorpipe::core
