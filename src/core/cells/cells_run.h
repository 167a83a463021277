/// The whole way from sites to cells as data.
#pragma once

#include "core/periodic/periodic_diagram.h"

namespace vorpipe::core {

/// What Session::cells does, but for the mass; checkOptions found nothing to refuse. For a picture, what the
/// cells were found with is kept. Errors: those of prepare; as Session::cells'.
Result<FoundCells> findCells(const Machine& machine, const Sites& sites, const CellsOptions& options,
                             ImagesFor purpose);

/// The same for data alone.
Result<Diagram> cellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options);

}  // namespace vorpipe::core
