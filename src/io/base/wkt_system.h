/// Coordinate systems in well-known text, of its first version, of ESRI's kind or of its second.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/base/coordinate_system.h"

namespace vorpipe {

/// The system that a definition is of: its kind, its code where it has one or a name that is common for one,
/// and the text itself. Nothing: it is no definition of one.
std::optional<CoordinateSystem> systemOfWkt(std::string_view text);

/// The name in a definition; empty where there is none.
std::string nameInWkt(std::string_view definition);

/// The kind of the system that text defines.
CoordinateKind kindOfWkt(std::string_view definition);

}  // namespace vorpipe
