/// What `--check` verifies on a run.
#pragma once

#include <string>

#include "cli/input.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Verifies the promises about a picture: a status for each site, owners of duplicates, no uncovered
/// pixel, and every pixel against the `cpu` backend, which asks in double which site is nearest.
/// Returns the first broken promise in one line, or an empty text. Errors: those of Session.
Result<std::string> checkRendering(const Input& input, const RenderOptions& options,
                                   const Rendering& rendering, int threads);

}  // namespace vorpipe::cli
