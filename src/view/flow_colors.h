/// Colors of a fluid's cells that stand for what flows.
#pragma once

#include <string>

#include "view/flowing.h"
#include "vorpipe.h"

namespace vorpipe::view {

/// The same picture of white cells, which colorFlow() gives their colors.
RenderOptions ofWhiteCells(RenderOptions options);

/// Sites whose weights are densities or speeds: colors by weight are then those of these values.
Sites valuesOf(const FluidState& state, FlowColor by);

/// Colors white cells of a picture, and what was drawn over them: map, scale (linear where none is named) and
/// range are those of `options`. With several places in a pixel, it has the color of the cell in its middle.
/// Errors: those of siteColors.
Result<void> colorFlow(const FluidState& state, FlowColor by, const RenderOptions& options, Image& image);

}  // namespace vorpipe::view
