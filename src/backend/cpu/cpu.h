/// The backend "cpu": the shared algorithm in C++, and the judge of every other backend.
#pragma once

#include <memory>

#include "backend/backend.h"

namespace vorpipe {

/// Never fails. Statuses are clipped in float, as on a GPU; cells in double; pictures ask for every
/// pixel center, in double, which site is nearest.
std::unique_ptr<Backend> makeCpuBackend(const BackendOptions& options);

/// The one device of this backend.
DeviceInfo cpuDevice();

}  // namespace vorpipe
