/// How far masses of cells are from those that are prescribed.
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

/// Fills `missing` with target - mass by site. Where cells fill the domain the targets are scaled to add up
/// to what the cells do, since only that can be reached; rounding then shows in no cell but where it arose.
Misfit misfitOf(const CellMoments& moments, std::span<const double> targets, Surface surface, int threads,
                std::vector<double>& missing);

}  // namespace vorpipe::moving
