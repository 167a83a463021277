/// Makes a picture of the globe.
#pragma once

#include "cells/site_run.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {

/// Implements Session::render where RenderOptions::globe is set; checkRender found nothing to refuse. Devices
/// have no part in it: pixels get their sites by a walk over the certified cells.
Result<Rendering> renderGlobe(const Machine& machine, const Sites& sites, const RenderOptions& options);

}  // namespace vorpipe::core
