/// The whole way from sites to a picture.
#pragma once

#include "core/judge/machine.h"

namespace vorpipe::core {

/// What Session::render does; checkOptions found nothing to refuse.
Result<Rendering> renderOn(const Machine& machine, const Sites& sites, const RenderOptions& options);

}  // namespace vorpipe::core
