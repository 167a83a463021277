/// The difference of cell masses from the prescribed ones.
#pragma once

#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

struct Misfit {
  double norm = 0;   ///< root of the sum of squared differences
  double worst = 0;  ///< largest |mass - target| / target
  double least = 0;  ///< least mass / target
};

/// Fills `missing` with target - mass by site. If cells fill the domain, the targets are scaled to the sum of
/// the cells' masses, since no other sum can be reached. Rounding then affects only the cells where it arose.
Misfit misfitOf(const CellMoments& moments, std::span<const double> targets, Surface surface, int threads,
                std::vector<double>& missing);

}  // namespace vorpipe::moving
