/// The whole way from sites to cells as data on one backend.
#pragma once

#include "core/prepare.h"

namespace vorpipe {

/// What Session::cells does, on an open backend, but for the mass; checkOptions found nothing to refuse.
/// Errors: those of prepare, which name the sites of `callers` if there are any; as Session::cells'.
Result<Diagram> cellsOn(Backend& backend, Backend& judge_backend, int threads, const Sites& sites,
                        const CellsOptions& options, const CallersSites* callers = nullptr);

/// Leaves of a diagram what Detail::measures has.
void dropPolygons(Diagram& diagram);

}  // namespace vorpipe
