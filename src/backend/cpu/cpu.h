/// The backend "cpu": the shared algorithm in C++.
#pragma once

#include <memory>

#include "backend/backend.h"

namespace vorpipe {

/// Never fails. Cells are found by the shared walk over the grid, as on a GPU. Pictures ask for every pixel
/// center, in double, which site is nearest.
std::unique_ptr<Backend> makeCpuBackend(const BackendOptions& options);

/// Whether `wanted` (BackendOptions::device) means the one device of this backend: empty, 0 or a part of
/// its name, in any case. Error (device) otherwise.
Result<void> checkCpuDevice(std::string_view wanted);

/// The one device of this backend.
DeviceInfo cpuDevice();

}  // namespace vorpipe
