/// From prepared sites to a Diagram, if the domain is a box.
#pragma once

#include "cells/site_run.h"

namespace vorpipe::core {

/// Does what Session::cells does, except outlines, periods and mass. `run` was begun with `sites`, on the
/// same machine. Stores the cells in `run` and moves its owners to the diagram. Errors: as in Session::cells.
Result<Diagram> boxDiagramOn(const Machine& machine, SiteRun& run, const Sites& sites,
                             const CellsOptions& options);

}  // namespace vorpipe::core
