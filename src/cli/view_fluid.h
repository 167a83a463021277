/// Opens a fluid from the command line for a window.
#pragma once

#include "cli/options/fluid_options.h"
#include "view/document.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Opens the fluid that the options name; it flows forever unless they set an end. Computes its first cells,
/// to report errors before a window opens. Errors: those of startOf, Session::open and Fluid::begin.
Result<view::Opened> openFluidForView(const FluidChoices& choices, const BackendOptions& backend,
                                      const SearchOptions& search);

}  // namespace vorpipe::cli
