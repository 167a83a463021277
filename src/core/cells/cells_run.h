/// The whole way from sites to cells as data on one backend.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// What Session::cells does, on an open backend, but for the mass; checkOptions found nothing to refuse.
/// Errors: those of prepare; as Session::cells'.
Result<Diagram> cellsOn(Backend& backend, Backend& judge_backend, int threads, const Sites& sites,
                        const CellsOptions& options);

}  // namespace vorpipe::core
