/// Masses that a transport is asked for, made to fit its domain.
#pragma once

#include <cstddef>

#include "vorpipe/result.h"
#include "vorpipe/transport.h"

namespace vorpipe {

class Session;

/// The mass that the cells of a transport share: what the density holds in the domain, or its area. Errors:
/// those of Session::cells.
Result<double> massOfDomain(Session& session, const TransportOptions& options);

/// Scales the masses of `options`, equal ones where there are none, so that those of all `sites` add up to
/// this part of massOfDomain(). Masses that are not finite and more than 0 stay as they are, for transport()
/// to refuse; without sites there are none. Errors: those of massOfDomain.
Result<void> fillDomain(Session& session, std::size_t sites, double part, TransportOptions& options);

}  // namespace vorpipe
