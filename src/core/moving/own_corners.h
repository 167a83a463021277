/// The cells of a run by their own corners, before ties join these: masses change smoothly with weights and
/// places of sites only so.
#pragma once

#include "core/cells/density_pixels.h"
#include "core/judge/neighbor_rows.h"
#include "core/moving/polygon_edges.h"
#include "core/vertices/cell_record.h"

namespace vorpipe::core {

/// Cells that were found and agreed on. All of it outlives the call.
struct OwnCorners {
  const SiteSet& set;
  const NeighborRows& rows;
  Unscale unscale;
  const Sites& places;  ///< in the caller's units; what the set has beyond them are images
  int threads;
};

/// Gives cells, whose areas and moments of the area stand in `moments`, those of their mass. The center of
/// mass is the centroid where there is none.
void weighCells(const OwnCorners& cells, const DensityPixels& pixels, CellMoments& moments);

}  // namespace vorpipe::core
