/// Masses that a transport is asked for, made to fit its domain.
#pragma once

#include <vector>

#include "vorpipe/result.h"
#include "vorpipe/transport.h"

namespace vorpipe {

class Session;

/// The mass that the cells of a transport share: what the density holds in the domain, or its area. Errors:
/// those of Session::cells.
Result<double> massOfDomain(Session& session, const TransportOptions& options);

/// Scales masses so that they add up to `whole`. They are finite and more than 0, or are left as they are.
void scaleTo(double whole, std::vector<double>& masses);

}  // namespace vorpipe
