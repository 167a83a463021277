/// Makes a picture from sites.
#pragma once

#include "cells/site_run.h"
#include "picture/kept_picture.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {

/// Implements Session::render; checkOptions found nothing to refuse.
Result<Rendering> renderOn(const Machine& machine, const Sites& sites, const RenderOptions& options);

/// Refuses options that renderOn would refuse, regardless of the sites.
Result<void> checkRender(const RenderOptions& options);

/// Renders the same picture from the kept data of another one; checkRender found nothing to refuse. `marks`
/// are those of its options.
Result<Rendering> renderKept(const Machine& machine, const Sites& sites, const RenderOptions& options,
                             const Marks& marks, KeptPicture& kept);

}  // namespace vorpipe::core
