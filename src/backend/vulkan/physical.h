/// The Vulkan devices of this machine, and which of them to take.
#pragma once

#include <volk.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "backend/capabilities.h"
#include "backend/vulkan/instance.h"
#include "vorpipe.h"

namespace vorpipe::vulkan {

/// A device before it is opened. `info` says whether it can be used and why not.
struct Physical {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
  Capabilities capabilities;  ///< masked
  std::uint32_t queue_family = 0;
  bool portability_subset = false;
};

/// What a device is to run; the backends "vulkan-geometry" and "vulkan-compute".
enum class Pipeline : std::uint8_t { geometry, compute };

/// The name of its backend.
std::string_view nameOf(Pipeline pipeline);

/// The devices in the order of vkEnumeratePhysicalDevices, as they would be for a pipeline and with mask.
/// Errors: none at all (device), an unknown name in the mask (input).
Result<std::vector<Physical>> enumerate(const Instance& instance, const Mask& mask,
                                        Pipeline pipeline = Pipeline::geometry);

/// The device that wanted names, by index or by a part of its name in any case; if empty, the best
/// usable one. Error (device): there is none; the message lists what there is.
Result<Physical> choose(std::span<const Physical> devices, std::string_view wanted);

}  // namespace vorpipe::vulkan
