/// Shaders as Vulkan takes them.
#pragma once

#include <volk.h>

#include <cstdint>
#include <span>

#include "backend/vulkan/device/device.h"
#include "backend/vulkan/device/handle.h"

namespace vorpipe::vulkan {

/// Of SPIR-V. Error (device): what Vulkan says.
Result<Handle<VkShaderModule>> shaderModule(const Device& device, std::span<const std::uint32_t> code);

}  // namespace vorpipe::vulkan
