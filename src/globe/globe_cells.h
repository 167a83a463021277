/// The cells of places on the Earth.
#pragma once

#include "cells/site_run.h"

namespace vorpipe::core {

/// Does what Session::cells does where CellsOptions::globe is set. Errors: as there.
Result<Diagram> globeCellsOn(const Machine& machine, const Sites& sites, const CellsOptions& options);

}  // namespace vorpipe::core
