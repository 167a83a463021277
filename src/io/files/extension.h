/// The kind of a file by its name.
#pragma once

#include <string>

namespace vorpipe {

/// The extension of `path` in lower case, with its dot; empty where there is none.
std::string lowerExtension(const std::string& path);

}  // namespace vorpipe
