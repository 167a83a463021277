/// A part of the domain that has mass everywhere.
#pragma once

#include "vorpipe.h"

namespace vorpipe::moving {

/// About the largest box with the domain's proportions that lies in the outline and where the density is
/// above 0, as samples tell: those of 128 rows and columns. The domain itself where none is found.
Box roomyBox(const CellsOptions& options);

}  // namespace vorpipe::moving
