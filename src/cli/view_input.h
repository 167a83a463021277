/// Sites and fluids for a window: from the command line, and from files dropped on it.
#pragma once

#include <string>

#include "cli/options/fluid_options.h"
#include "cli/options/options.h"
#include "view/document.h"
#include "view/frames.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Opens the sites that the options name, or a few random ones if they name none, with their domain. Errors:
/// those of loadInput and checkInput.
Result<view::Opened> openForView(const InputOptions& options, const TalkOptions& talk);

/// Opens the fluid that the options name; it flows forever unless they set an end. Computes its first cells,
/// to report errors before a window opens. Errors: those of startOf, Session::open and Fluid::begin.
Result<view::Opened> openFluidForView(const FluidChoices& choices, const BackendOptions& backend,
                                      const SearchOptions& search);

/// Loads a dropped file: a density from a .png, a fluid from an .npz, else sites, read as `options` say.
/// Errors: those of readDensity, readFluid and loadInput.
Result<view::Loaded> loadForView(const std::string& path, const InputOptions& options);

}  // namespace vorpipe::cli
