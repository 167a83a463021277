/// Sites with weights: what data sets of them are made of.
#pragma once

#include "support/sites/random_sites.h"

namespace vorpipe::test {

/// Gives site i the weight weigh(i).
template <class Weigh>
Sites weighted(Sites sites, const Weigh& weigh) {
  sites.weight.clear();
  for (std::size_t i = 0; i < sites.size(); ++i) sites.weight.push_back(weigh(i));
  return sites;
}

/// Weights from `least` to `most`, in squares of the mean spacing of sites in the unit square.
Sites withRandomWeights(Sites sites, double least, double most, Random& random);

/// Towns by degrees, in whole inhabitants: few are large, and most of their neighbors hidden. A tenth of them
/// stand where another one does, heavier, lighter or equal.
Sites populatedTowns(std::uint64_t n, Random& random);

/// Right ascension and declination in degrees, evenly on the sphere; weights fall by the hundredth part with
/// every five magnitudes, and there are three times as many stars of each magnitude as of that before.
Sites brightStars(std::uint64_t n, Random& random);

/// A square lattice with sites inside of its squares that are just hidden, just not, or exactly neither, by
/// the last bits of their weights; all in integers.
Sites onTheVerge(std::uint64_t n, Random& random);

/// Integers on a square lattice, with weights that leave a cell to the four in its corners alone, and those
/// on its sides exactly on the verge.
Sites flattened(std::uint64_t n);

/// A square lattice in steps of 2, every other site of which is lighter, as on a chessboard: by 4, and it is
/// on the verge of being hidden.
Sites chessboard(std::uint64_t n, double lighter);

/// A hexagonal lattice of three weights.
Sites threeWeights(std::uint64_t n);

/// Pairs 1e-12 of the domain apart, with weights that hide one of them, or hardly.
Sites unequalPairs(std::uint64_t n, Random& random);

}  // namespace vorpipe::test
