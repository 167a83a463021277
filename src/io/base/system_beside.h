/// The coordinate system that a file beside another one names.
#pragma once

#include <string>

#include "io/base/coordinate_system.h"

namespace vorpipe {

/// Reads the .prj beside a file, "towns.prj" for "towns.csv" and "towns.csv.gz", if it exists and nothing
/// else names the file's system. `system` is the file's, and gets what is read. Errors (input): the .prj is
/// no WKT definition, or its kind of coordinates differs from that of `system`.
Result<void> readSystemBeside(const std::string& path, CoordinateSystem& system);

/// Returns the path with another extension, which begins with a dot; of x.csv.gz, both extensions are
/// replaced.
std::string besides(const std::string& path, const std::string& extension);

}  // namespace vorpipe
