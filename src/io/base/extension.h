/// The kind of a file by its name.
#pragma once

#include <string>

namespace vorpipe {

/// The extension of `path` in lower case, with its dot; empty where there is none.
std::string lowerExtension(const std::string& path);

/// The extension that tells what an input holds: that of lowerExtension, but of x.csv.gz that of x.csv.
std::string inputExtension(const std::string& path);

}  // namespace vorpipe
