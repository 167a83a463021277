/// Cells of a periodic domain, from an ordinary diagram of the sites and some images.
#pragma once

#include <memory>

#include "cells/site_run.h"
#include "sites/scene.h"

namespace vorpipe::core {

/// Cells, and on request the run that found them.
struct PeriodicCells {
  Diagram diagram;
  std::unique_ptr<SiteRun> run;  ///< null if only data is wanted
  Scene scene;                   ///< of the run
};

/// Does what Session::cells does if options.periodic names an axis, except for outlines and mass. Errors:
/// those of boxDiagramOn and placeSites.
Result<PeriodicCells> periodicCellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options,
                                      ImagesFor purpose);

}  // namespace vorpipe::core
