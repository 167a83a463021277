/// The subcommand `cells`, in the plane and in space.
#pragma once

#include "cli/options/cells_outputs.h"
#include "cli/options/density_options.h"
#include "cli/options/mass_options.h"
#include "cli/run.h"

namespace vorpipe::cli {

struct CellsCommand : RunOptions {
  InputOptions input;
  Surface surface = Surface::none;
  CellsTargets targets;
  DensityOptions density;
};

/// Whether the sites have three coordinates: --dim 3, or what implies it.
bool isInSpace(const InputOptions& input);

/// Computes cells in space, and writes them.
Result<ExitCode> cellsInSpace(const CellsCommand& command, const Invocation& how);

}  // namespace vorpipe::cli
