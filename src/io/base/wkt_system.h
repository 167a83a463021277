/// Coordinate systems in well-known text: version 1, ESRI's variant or version 2.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/base/coordinate_system.h"

namespace vorpipe {

/// Returns the system that a definition describes: its kind, its code if it has one or a common name implies
/// one, and the text itself. None if it defines no system.
std::optional<CoordinateSystem> systemOfWkt(std::string_view text);

/// Returns the name in a definition; empty if there is none.
std::string nameInWkt(std::string_view definition);

/// The kind of the system that text defines.
CoordinateKind kindOfWkt(std::string_view definition);

}  // namespace vorpipe
