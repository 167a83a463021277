/// Cells of a periodic domain: those of an ordinary diagram of the sites and some images.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// What Session::cells does where options.periodic names an axis. Errors: those of boxDiagramOn and
/// placeSites.
Result<Diagram> periodicCellsOn(Backend& backend, Backend& judge_backend, int threads, const Sites& sites,
                                const CellsOptions& options);

}  // namespace vorpipe::core
