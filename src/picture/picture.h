/// The whole way from sites to a picture.
#pragma once

#include "cells/machine.h"
#include "picture/kept_picture.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {

/// What Session::render does; checkOptions found nothing to refuse.
Result<Rendering> renderOn(const Machine& machine, const Sites& sites, const RenderOptions& options);

/// Refuses what renderOn does, of the options alone.
Result<void> checkRender(const RenderOptions& options);

/// The same picture, from what another one was drawn from; checkRender found nothing to refuse. `marks`
/// are those of its options.
Result<Rendering> renderKept(const Machine& machine, const Sites& sites, const RenderOptions& options,
                             const Marks& marks, KeptPicture& kept);

}  // namespace vorpipe::core
