/// The whole pipeline from sites to cells as data.
#pragma once

#include <memory>

#include "cells/site_run.h"
#include "domain/clip_diagram.h"
#include "sites/images.h"

namespace vorpipe::core {

/// Cells, and on request the run that found them.
struct FoundCells {
  Diagram diagram;
  std::unique_ptr<SiteRun> run;  ///< null if only data is wanted
  Scene scene;                   ///< of the run
  OwnParts parts{};              ///< for cells that an outline cuts
};

/// Does what Session::cells does, except for the mass; checkOptions has accepted the input. For a picture, it
/// keeps the run and its scene. Errors: those of prepare and of Session::cells.
Result<FoundCells> findCells(const Machine& machine, const Sites& sites, const CellsOptions& options,
                             ImagesFor purpose);

/// The same, for data only.
Result<Diagram> cellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options);

}  // namespace vorpipe::core
