/// Device memory: where it is and who can access it.
#pragma once

#include <volk.h>

#include <cstdint>
#include <string_view>

#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"

namespace vorpipe::vulkan {

enum class Placement : std::uint8_t {
  device,    ///< only the device uses it
  upload,    ///< the host writes, the device reads: in the device's own memory where that can be mapped
  download,  ///< the device writes, the host reads: in the host's cached memory if there is any
};

/// Allocates memory for `what` (a word for the message) in the best heap that has room for it.
/// upload and download memory can be mapped and is coherent.
Result<Handle<VkDeviceMemory>> allocate(const Device& device, const VkMemoryRequirements& needed,
                                        Placement placement, std::string_view what);

}  // namespace vorpipe::vulkan
