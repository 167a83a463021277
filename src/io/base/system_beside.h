/// The coordinate system that a file beside another one names.
#pragma once

#include <string>

#include "io/base/coordinate_system.h"

namespace vorpipe {

/// Reads the .prj beside a file, "towns.prj" for "towns.csv" and "towns.csv.gz", where there is one and
/// nothing else names the file's system: `system` is that of the file, and gets what is read. Errors (input):
/// the .prj is no definition in WKT, or one of another kind of coordinates than `system` has.
Result<void> readSystemBeside(const std::string& path, CoordinateSystem& system);

/// The path with another extension, which begins with a dot; .gz and what stands before it are replaced.
std::string besides(const std::string& path, const std::string& extension);

}  // namespace vorpipe
