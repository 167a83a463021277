/// The cells in an outline by their own corners.
#pragma once

#include "core/moving/own_corners.h"

namespace vorpipe::core {

/// Measures the cells of a run, inside an outline, anew: `moments` has those of their polygons, to which ties
/// joined their corners. Where they meet the outline, which `meet` and `polygons` say, they are clipped to it
/// again. `pixels` may be null: there is no density. Errors: those of ringsOf.
Result<void> measureOutlined(const OwnCorners& cells, const Outline& outline, int exponent,
                             const CellsThatMeet& meet, const CellPolygons& polygons,
                             const DensityPixels* pixels, CellMoments& moments);

}  // namespace vorpipe::core
