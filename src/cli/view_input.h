/// Sites of a window: those of the command line, and those of files that are dropped on it.
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "view/opened.h"
#include "view/wish.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// The sites that options name, or a few random ones where they name none, with their domain. Errors: those
/// of loadInput and checkInput.
Result<view::Opened> openForView(const InputOptions& options, const TalkOptions& talk);

/// What is in a file that was dropped: of a .png a density, of an .npz a fluid, else sites; how files are
/// read is as `options` have it. Errors: those of readDensity, readFluid and loadInput.
Result<view::Loaded> loadForView(const std::string& path, const InputOptions& options);

/// The options of a command line that read as these do. Those of standard input name nothing.
std::vector<std::string> argumentsOf(const InputOptions& options);

}  // namespace vorpipe::cli
