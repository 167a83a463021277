/// Fluids of a window, as the command line names them.
#pragma once

#include "cli/options/fluid_options.h"
#include "view/opened.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// The fluid that options name, which flows on unless they say when it ends; its first cells are found, so
/// that what is wrong with it is told before there is a window. Errors: those of startOf, Session::open and
/// Fluid::begin.
Result<view::Opened> openFluidForView(const FluidChoices& choices, const BackendOptions& backend,
                                      const SearchOptions& search);

}  // namespace vorpipe::cli
