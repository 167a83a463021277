/// The whole way from prepared sites to cells as data, where the domain is a box.
#pragma once

#include "cells/site_run.h"

namespace vorpipe::core {

/// What Session::cells does, but for outlines, periods and mass. `run` was begun with `sites`, on the same
/// machine, and has the cells afterwards; its owners are the diagram's. Errors: as Session::cells'.
Result<Diagram> boxDiagramOn(const Machine& machine, SiteRun& run, const Sites& sites,
                             const CellsOptions& options);

}  // namespace vorpipe::core
