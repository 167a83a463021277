/// Masses that are asked for, and whether they can be.
#pragma once

#include <vector>

#include "vorpipe.h"

namespace vorpipe::moving {

/// By site: those of the options, or equal shares of `whole`, the mass of the domain. Errors (input,
/// Subject::masses): another number of masses than sites; one that is not finite or not more than 0; a sum
/// that is not that of the domain, or, with a free surface, more than that.
Result<std::vector<double>> targetsOf(const TransportOptions& options, std::size_t sites, double whole);

}  // namespace vorpipe::moving
