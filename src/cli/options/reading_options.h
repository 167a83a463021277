/// The options for reading a file with sites.
#pragma once

#include "cli/options/options.h"

namespace vorpipe::cli {

/// --columns, --missing, --layer, --format. Attributes are dropped unless the subcommand keeps them.
void addReadingOptions(Options& options, InputOptions& input, const Option& sites);

}  // namespace vorpipe::cli
