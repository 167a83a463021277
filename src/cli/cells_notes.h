/// Notes about files of cells.
#pragma once

#include "cli/options/cells_outputs.h"
#include "cli/options/options.h"
#include "io/cells/cells_file.h"

namespace vorpipe::cli {

/// Prints up to three lines on standard error, unless the run is quiet: how many records --only-cells left
/// out; which attributes were renamed in the files; that GeoJSON has coordinates of a plane, which readers
/// take for degrees.
void printCellsNotes(const TalkOptions& talk, const CellsTargets& targets, const CellsOutput& output);

}  // namespace vorpipe::cli
