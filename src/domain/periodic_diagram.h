/// Cells of a periodic domain: those of an ordinary diagram of the sites and some images.
#pragma once

#include <memory>

#include "cells/site_run.h"
#include "sites/scene.h"

namespace vorpipe::core {

/// Cells, and where the caller wants more of them, what they were found with.
struct PeriodicCells {
  Diagram diagram;
  std::unique_ptr<SiteRun> run;  ///< null where only data is wanted
  Scene scene;                   ///< of the run
};

/// What Session::cells does where options.periodic names an axis, but for outlines and mass. Errors: those of
/// boxDiagramOn and placeSites.
Result<PeriodicCells> periodicCellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options,
                                      ImagesFor purpose);

}  // namespace vorpipe::core
