/// Measures the sites of a diagram: their energy, and where each is to move.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/allowed_places.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// By site, in input order. Vectors of two numbers for each site have all x first, then all y.
struct MeasuredSites {
  std::vector<double> gradient;  ///< of the energy: 2 m (p - c)
  std::vector<double> inverse;   ///< 1 / (2 m); 0 where there is no mass
  std::vector<double> way;       ///< to the centroid, or to the allowed place nearest to it
  double energy = 0;
  double scale = 0;     ///< the same sum of absolute values: rounding errors are relative to this
  double area = 0;      ///< of all cells
  double farthest = 0;  ///< the longest of `way`, in the caller's unit
  std::uint64_t cells = 0;
  bool has_lost = false;  ///< some sites have no mass
};

/// Measures sites at the places of the moments, along periodic axes as placed by wrapped().
MeasuredSites measureSites(const Sites& sites, const CellMoments& moments, const AllowedPlaces& allowed,
                           int threads);

}  // namespace vorpipe::moving
