/// What is measured on, such that every program can take it as it is.
#pragma once

#include "support/sites/data_sets.h"

namespace vorpipe::test {

/// Sites no two of which are equal, on a grid of 2^-30 of the domain's side: Boost takes integers, and
/// programs do not agree about what becomes of duplicates.
struct BenchInput {
  DataSet set;  ///< in the units of the data set

  /// The same, exactly, in units in which neighbors are about 1 apart and the domain begins at the origin:
  /// Voro++ and d3-delaunay compare lengths with constants.
  Sites sites;
  Box domain;
  double unit;  ///< of these in the set's, a power of two
  double grid;  ///< its spacing in these units, a power of two
};

/// Puts a data set on the grid. `weights`: 0, or how far the random weights of sites without any reach from
/// 0, in squares of the mean distance of neighbors.
BenchInput makeInput(DataSet set, double weights, std::uint64_t seed);

}  // namespace vorpipe::test
