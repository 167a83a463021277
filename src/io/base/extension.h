/// File kinds by extension.
#pragma once

#include <string>

namespace vorpipe {

/// Returns the extension of `path` in lower case, with its dot; empty if there is none.
std::string lowerExtension(const std::string& path);

/// Returns the extension that identifies an input's format: as lowerExtension, except .csv for x.csv.gz.
std::string inputExtension(const std::string& path);

}  // namespace vorpipe
