#include "backend/vulkan/shader_module.h"

#include "backend/vulkan/error.h"
#include "backend/vulkan/structure.h"

namespace vorpipe::vulkan {

Result<Handle<VkShaderModule>> shaderModule(const Device& device, const shaders::Spirv& spirv) {
  const auto code = device.unrolled() ? spirv.unrolled : spirv.rolled;
  auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  return create(device.handle(), device.api().vkCreateShaderModule, device.api().vkDestroyShaderModule, info,
                "vkCreateShaderModule");
}

}  // namespace vorpipe::vulkan
