/// The prescribed masses, and whether they are possible.
#pragma once

#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

/// Returns masses by site: those of the options, or equal shares of `whole`, the mass of the domain. Errors
/// (input, Subject::masses): the number of masses differs from that of sites; a mass is not finite or not
/// more than 0; the sum is not that of the domain, or, with a free surface, more than that.
Result<std::vector<double>> targetsOf(const TransportOptions& options, std::size_t sites, double whole);

}  // namespace vorpipe::moving
