/// The devices that OpenGL lists, and the choice of one.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "backend/backend.h"
#include "backend/capabilities.h"
#include "backend/opengl/context.h"

namespace vorpipe::opengl {

/// One device with its context; without one if it cannot be used, for the reason in info.
struct Device {
  DeviceInfo info;
  Capabilities capabilities;  ///< masked
  std::optional<Context> context;
};

/// Returns every device for which openContexts() returns a context or an error, as it would be under mask. If
/// there is none, returns one that says why.
std::vector<Device> findDevices(const Mask& mask, Drivers drivers);

/// The device named by an index or a part of a name in any case, or the best one if wanted is empty.
/// Error (device): there is no such device, or it cannot be used.
Result<Device> chooseDevice(std::vector<Device> devices, std::string_view wanted);

/// Returns the BackendInfo for a device.
BackendInfo backendInfo(const Device& device);

}  // namespace vorpipe::opengl
