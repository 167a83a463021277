/// The whole way from sites to cells as data.
#pragma once

#include "domain/own_parts.h"
#include "domain/periodic_diagram.h"

namespace vorpipe::core {

/// Cells, and where the caller wants more of them, what they were found with.
struct FoundCells {
  Diagram diagram;
  std::unique_ptr<SiteRun> run;  ///< null where only data is wanted
  Scene scene;                   ///< of the run
  OwnParts parts{};              ///< of cells that an outline cuts
};

/// What Session::cells does, but for the mass; checkOptions found nothing to refuse. For a picture, what the
/// cells were found with is kept. Errors: those of prepare; as Session::cells'.
Result<FoundCells> findCells(const Machine& machine, const Sites& sites, const CellsOptions& options,
                             ImagesFor purpose);

/// The same for data alone.
Result<Diagram> cellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options);

}  // namespace vorpipe::core
