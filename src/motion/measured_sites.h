/// What a diagram says of its sites: their energy, and where each wants to go.
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
  std::vector<double> way;       ///< to the centroid, or to the allowed place that is nearest to it
  double energy = 0;
  double scale = 0;     ///< the same sum without signs: rounding is a part of this
  double area = 0;      ///< of all cells
  double farthest = 0;  ///< the longest of `way`, in the caller's unit
  std::uint64_t cells = 0;
  bool has_lost = false;  ///< sites that have no mass
};

/// Of sites that stand where the moments were measured, along periodic axes as wrapped() places them.
MeasuredSites measureSites(const Sites& sites, const CellMoments& moments, const AllowedPlaces& allowed,
                           int threads);

}  // namespace vorpipe::moving
