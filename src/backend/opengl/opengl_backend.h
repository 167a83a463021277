/// The OpenGL 4.1 core backend: what a Mac, an old laptop or a driver without Vulkan can run.
#pragma once

#include <memory>
#include <vector>

#include "backend/backend.h"

namespace vorpipe {

/// Opens the device that options.device names (an index of listOpenGlDevices, or a part of a name in
/// any case), or the best usable one if it is empty. Needs no display.
/// Errors: the mask names something unknown (input); no such device, or none that can be used or is of
/// `drivers` (device).
Result<std::unique_ptr<Backend>> makeOpenGlBackend(const BackendOptions& options,
                                                   Drivers drivers = Drivers::any);

/// Returns every device that OpenGL lists here, as it would be under mask; if there is none, one entry that
/// says why.
std::vector<DeviceInfo> listOpenGlDevices(const Mask& mask);

}  // namespace vorpipe
