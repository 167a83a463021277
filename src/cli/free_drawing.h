/// Pictures of cells with a free surface.
#pragma once

#include <string_view>

#include "cli/drawing.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Refuses (input) sites without weights, whose discs have no radii.
Result<void> checkDiscs(const Sites& sites);

/// Refuses (input) what pictures of air and pixels cannot have, in words that begin with the option.
Result<void> checkFreePicture(std::string_view option, const RenderOptions& options,
                              const DrawingNeeds& needs);

/// Makes what is needed, as draw() does, of the parts of cells that lie in the discs around their sites.
/// Errors: those of Session::render, freeCells and takeOutAir.
Result<Drawing> drawFree(Session& session, const Sites& sites, const RenderOptions& options,
                         const DrawingNeeds& needs);

}  // namespace vorpipe::cli
