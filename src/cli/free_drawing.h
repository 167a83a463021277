/// Pictures of cells with a free surface.
#pragma once

#include <string_view>

#include "cli/drawing.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Error (input): the sites have no weights, so their discs have no radii.
Result<void> checkDiscs(const Sites& sites);

/// Error (input), in words that begin with the option: a picture has marks or colors that pictures with air
/// cannot have in pixels.
Result<void> checkFreePicture(std::string_view option, const RenderOptions& options,
                              const DrawingNeeds& needs);

/// Makes the needed parts, like draw(), from the parts of cells inside the discs around their sites.
/// Errors: those of Session::render, freeCells and takeOutAir.
Result<Drawing> drawFree(Session& session, const Sites& sites, const RenderOptions& options,
                         const DrawingNeeds& needs);

}  // namespace vorpipe::cli
