/// Reads cells of .npz files, as far as diffCells compares them.
#pragma once

#include "io/base/zip_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// Whether an archive has cells in space, as the one of writeSpaceCells.
bool hasSpaceCells(const NpzFile& file);

/// Read status, owner, areas or volumes, neighbors and shifts. Error (input): an array is missing, or does
/// not fit the others.
Result<Diagram> readNpzCells(const NpzFile& file);
Result<Diagram3> readSpaceCells(const NpzFile& file);

}  // namespace vorpipe
