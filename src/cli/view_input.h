/// Sites for a window: from the command line, and from files dropped on it.
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "view/document.h"
#include "view/frames.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// Opens the sites that the options name, or a few random ones if they name none, with their domain. Errors:
/// those of loadInput and checkInput.
Result<view::Opened> openForView(const InputOptions& options, const TalkOptions& talk);

/// Loads a dropped file: a density from a .png, a fluid from an .npz, else sites, read as `options` say.
/// Errors: those of readDensity, readFluid and loadInput.
Result<view::Loaded> loadForView(const std::string& path, const InputOptions& options);

/// Returns command-line options equivalent to these; empty for standard input.
std::vector<std::string> argumentsOf(const InputOptions& options);

}  // namespace vorpipe::cli
