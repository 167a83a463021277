/// A part of the domain that has mass everywhere.
#pragma once

#include "vorpipe.h"

namespace vorpipe::moving {

/// Returns about the largest box with the domain's proportions that lies in the outline and has a density
/// above 0. It is found from samples in 128 rows and columns. Returns the domain itself if there is none.
Box roomyBox(const CellsOptions& options);

}  // namespace vorpipe::moving
