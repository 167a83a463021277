/// The options of the domain, and of the projection to its plane.
#pragma once

#include "cli/options/options.h"

namespace vorpipe::cli {

/// A number of 0 or more, optionally followed by %.
Parsed<Margin> parseMargin(std::string_view text);

/// `auto`, or `LON,LAT`, a place on the Earth.
Parsed<ProjectChoice> parseProject(std::string_view text);

/// --domain, --domain-layer, --margin, --repair, --project
void addDomainOptions(Options& options, InputOptions& input, const Option& sites);

}  // namespace vorpipe::cli
