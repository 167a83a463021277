/// Checks of input that moves: sites in domains whose energies fit in a double.
#pragma once

#include "vorpipe.h"

namespace vorpipe::moving {

/// Makes the checks of checkInput(), and more. Energies are masses times squared lengths, and squares of
/// energies are summed. So sides of the domain are 1e-40 to 1e40, and the largest density is 1e-30 to 1e30.
/// Errors (input).
Result<void> checkMovable(const Sites& sites, const CellsOptions& options, int threads);

/// Which axes repeat.
struct RepeatingAxes {
  bool x, y;
};
RepeatingAxes repeats(Periodic periodic);

/// Refuses (input) two sites at one place, since neither can have a mass of its own. Both ends of a period
/// are one place; sites are inside of it.
Result<void> checkPlaces(const Sites& sites, const Box& domain, Periodic periodic);

/// Refuses (input) an invalid tolerance: less than 0, or not a number.
Result<void> checkTolerance(double tolerance);

}  // namespace vorpipe::moving
