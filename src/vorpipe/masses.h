/// Target masses of a transport, scaled to fit its domain.
#pragma once

#include <cstddef>

#include "vorpipe/result.h"
#include "vorpipe/transport.h"

namespace vorpipe {

class Session;

/// The mass that the cells of a transport share: the density's mass in the domain, or its area. Errors: those
/// of Session::cells.
Result<double> massOfDomain(Session& session, const TransportOptions& options);

/// Scales the masses of `options`, or equal ones if there are none: those of all `sites` then add up to this
/// part of massOfDomain(). Masses that are not finite and positive stay as they are, for transport() to
/// refuse; without sites there are none. Errors: those of massOfDomain.
Result<void> fillDomain(Session& session, std::size_t sites, double part, TransportOptions& options);

}  // namespace vorpipe
