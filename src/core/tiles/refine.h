/// A finer grid for a crowded region.
#pragma once

#include "core/tiles/dense_regions.h"

namespace vorpipe::core {

/// The sites of a region, and of the bins around it, in a grid that fits the region's own sites.
struct RefinedRegion {
  SiteSet sites;
  std::vector<std::uint32_t> whole;  ///< by index in `sites`: index in the set that the region is of
  std::vector<std::uint32_t> own;    ///< the region's own sites, indices in `sites`, ascending
};

/// The grid covers the region's own sites with a small margin; the other sites of its coverage are in the
/// bins at its border. All sites whose cells are to be found lie within the grid.
RefinedRegion refine(const SiteSet& sites, const CrowdedRegion& region, int threads);

}  // namespace vorpipe::core
