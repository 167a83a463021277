/// How a file with sites is read.
#pragma once

#include "cli/options/options.h"

namespace vorpipe::cli {

/// --columns, --missing, --layer, --format. Attributes are not kept, unless the subcommand says so.
void addReadingOptions(Options& options, InputOptions& input, const Option& sites);

}  // namespace vorpipe::cli
