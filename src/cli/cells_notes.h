/// What must be said of files of cells.
#pragma once

#include "cli/options/cells_outputs.h"
#include "cli/options/options.h"
#include "io/cells/cells_file.h"

namespace vorpipe::cli {

/// Prints a line on standard error, unless the run is quiet, for each of these: how many records --only-cells
/// left out; which attributes have other names in the files; that coordinates of a plane are in GeoJSON,
/// where readers take them for degrees.
void printCellsNotes(const TalkOptions& talk, const CellsTargets& targets, const CellsOutput& output);

}  // namespace vorpipe::cli
