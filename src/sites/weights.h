/// The weights of a SiteSet, from those of the caller, and the largest of bins and blocks: Grid::heaviest.
#pragma once

#include "backend/site_set.h"
#include "sites/grid.h"

namespace vorpipe::core {

/// Whether two weights differ; false without weights.
bool hasWeights(const Sites& sites);

/// Weights by input index in the units of a SiteSet, which are the input's times 4^exponent. Subtracts the
/// least from all if that rounds none: a number added to all then changes nothing, and else they are not far
/// from 0. Empty if all are equal, or if there are none. Errors (input): a weight that is not finite, or is
/// more than 2^600 squared domains.
Result<std::vector<double>> scaledWeights(const Sites& sites, int exponent, int threads);

/// Sets weight, heavy and grid.heaviest, from weights by input index, in a set whose sites are already in
/// their bins. Sets none if all weights of the set's sites are equal.
void giveWeights(const std::vector<double>& by_input, int threads, SiteSet& set);

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
