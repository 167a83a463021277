/// Cells in each feature of an outline: `cells --by`.
#pragma once

#include "cli/options/cells_outputs.h"
#include "cli/run.h"

namespace vorpipe::cli {

/// Sets the format of standard output, and rejects options of cells that pieces do not have. Errors (input).
Result<void> takePiecesFormat(CellsTargets& targets, const std::string& kind);

/// Computes the pieces of an input with parts, and writes them. Errors: those of piecesOf and of files.
Result<ExitCode> writePiecesOf(CommandRun& run, const InputOptions& from, Input& input,
                               const CellsTargets& targets);

}  // namespace vorpipe::cli
