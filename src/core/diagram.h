/// The whole way from sites to cells as data on one backend.
#pragma once

#include "backend/backend.h"

namespace vorpipe {

/// What Session::cells does, on an open backend.
Result<Diagram> cellsOn(Backend& backend, Backend& judge_backend, int threads, const Sites& sites,
                        const CellsOptions& options);

/// Leaves of a diagram what Detail::measures has.
void dropPolygons(Diagram& diagram);

}  // namespace vorpipe
