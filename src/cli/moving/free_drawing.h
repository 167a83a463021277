/// Pictures of cells with a free surface.
#pragma once

#include "cli/runs/drawing.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Refuses (input) what pictures of air and pixels cannot have.
Result<void> checkFreePicture(const RenderOptions& options, const DrawingNeeds& needs);

/// Makes what is needed, as draw() does, of the parts of cells that lie in the discs around their sites.
/// Errors: those of Session::render, freeCells and takeOutAir.
Result<Drawing> drawFree(Session& session, const Sites& sites, const RenderOptions& options,
                         const DrawingNeeds& needs);

}  // namespace vorpipe::cli
