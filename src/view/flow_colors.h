/// Colors of a fluid's cells by density or speed.
#pragma once

#include <string>

#include "view/flowing.h"
#include "vorpipe.h"

namespace vorpipe::view {

/// Returns options for the same picture with white cells, which colorFlow() then colors.
RenderOptions ofWhiteCells(RenderOptions options);

/// Returns sites whose weights are densities or speeds, so that coloring by weight shows these values.
Sites valuesOf(const FluidState& state, FlowColor by);

/// Colors the white cells of a picture and the marks over them. Map, scale (linear if none is named) and
/// range are those of `options`. A pixel with several samples gets the color of the cell at its center.
/// Errors: those of siteColors.
Result<void> colorFlow(const FluidState& state, FlowColor by, const RenderOptions& options, Image& image);

}  // namespace vorpipe::view
