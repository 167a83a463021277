/// Colors of a map in a file.
#pragma once

#include <string>
#include <vector>

#include "vorpipe.h"

namespace vorpipe {

/// Reads opaque colors, one to a line, as readColor() takes them; empty lines are skipped. Errors (input),
/// with file and line: a line is no such color; there are fewer than 2 or more than 254.
Result<std::vector<Color>> readColors(const std::string& path);

}  // namespace vorpipe
