/// The backend "cpu": the shared algorithm in C++.
#pragma once

#include <memory>

#include "backend/backend.h"

namespace vorpipe {

/// Never fails. Cells are found by the shared walk over the grid, as on a GPU. For pictures, the nearest site
/// of every pixel center is found in double.
std::unique_ptr<Backend> makeCpuBackend(const BackendOptions& options);

/// Checks that `wanted` (BackendOptions::device) means the only device of this backend: empty, 0 or a part of
/// its name, in any case. Error (device) otherwise.
Result<void> checkCpuDevice(std::string_view wanted);

/// Returns the only device of this backend.
DeviceInfo cpuDevice();

}  // namespace vorpipe
