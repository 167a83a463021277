/// Cells on the sphere inside of an outline.
#pragma once

#include "cells/site_run.h"
#include "globe/direction.h"

namespace vorpipe::core {

/// The cells of sites on the sphere inside of the outline of `options`, which is in degrees: without the
/// triangles of a Diagram. Errors (input): the outline is invalid; one of its polygons reaches too far around
/// the Earth.
Result<Diagram> outlinedCellsOn(const Machine& machine, const Sites& sites, const SphereSites& placed,
                                const CellsOptions& options);

}  // namespace vorpipe::core
