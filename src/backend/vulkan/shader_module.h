/// Shader modules of Vulkan.
#pragma once

#include <volk.h>

#include "backend/vulkan/device.h"
#include "backend/vulkan/handle.h"
#include "shaders.h"

namespace vorpipe::vulkan {

/// Of SPIR-V, with its loops or without, as the device gets it. Error (device): what Vulkan says.
Result<Handle<VkShaderModule>> shaderModule(const Device& device, const shaders::Spirv& spirv);

}  // namespace vorpipe::vulkan
