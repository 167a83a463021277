/// The whole way from sites to a picture on one backend.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// What Session::render does, on an open backend; checkOptions found nothing to refuse.
Result<Rendering> renderOn(Backend& backend, Backend& judge, int threads, const Sites& sites,
                           const RenderOptions& options);

}  // namespace vorpipe::core
