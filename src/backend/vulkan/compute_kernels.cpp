#include "backend/vulkan/compute_kernels.h"

#include <cassert>
#include <utility>

#include "backend/vulkan/device.h"
#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

Result<Handle<VkPipeline>> build(const Device& device, VkPipelineCache cache, VkPipelineLayout layout,
                                 const ComputeKernels::Code& code, bool flag) {
  const VolkDeviceTable& api = device.api();
  VORPIPE_VAR(module, shaderModule(device, code));
  auto info = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage =
      structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.get();
  info.stage.pName = "main";
  info.layout = layout;
  const VkSpecializationMapEntry entry{0, 0, sizeof(VkBool32)};
  const VkBool32 value = flag ? VK_TRUE : VK_FALSE;
  const VkSpecializationInfo constants{1, &entry, sizeof(value), &value};
  info.stage.pSpecializationInfo = &constants;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult made = device.pipelines().time(code.name, [&] {
    return api.vkCreateComputePipelines(device.handle(), cache, 1, &info, nullptr, &pipeline);
  });
  VORPIPE_TRY(check(made, "vkCreateComputePipelines"));
  return Handle<VkPipeline>(device.handle(), pipeline, api.vkDestroyPipeline);
}

void setUp(const Device& device, VkCommandBuffer commands, VkPipeline kernel, const Bindings& bindings,
           const Slice& slice) {
  const VolkDeviceTable& api = device.api();
  const VkDescriptorSet set = bindings.set();
  api.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel);
  api.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, bindings.layout(), 0, 1, &set, 0,
                              nullptr);
  api.vkCmdPushConstants(commands, bindings.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(slice), &slice);
}

}  // namespace

Result<ComputeKernels> ComputeKernels::create(const Device& device) {
  ComputeKernels kernels;
  const auto info = structure<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
  VORPIPE_VAR(cache, vulkan::create(device.handle(), device.api().vkCreatePipelineCache,
                                    device.api().vkDestroyPipelineCache, info, "vkCreatePipelineCache"));
  kernels.cache_ = std::move(cache);
  return kernels;
}

Result<VkPipeline> ComputeKernels::kernel(const Device& device, VkPipelineLayout layout, Code code,
                                          bool flag) {
  Handle<VkPipeline>& pipeline = made_[{code.name, flag}];
  if (!pipeline) {
    VORPIPE_VAR(built, build(device, cache_.get(), layout, code, flag));
    pipeline = std::move(built);
  }
  return pipeline.get();
}

void dispatch(const Device& device, VkCommandBuffer commands, VkPipeline kernel, const Bindings& bindings,
              const Slice& slice, std::size_t invocations) {
  const std::size_t groups = (invocations + GROUP_SIZE - 1) / GROUP_SIZE;
  assert(groups <= most_groups);
  setUp(device, commands, kernel, bindings, slice);
  device.api().vkCmdDispatch(commands, static_cast<std::uint32_t>(groups), 1, 1);
}

void dispatchIndirect(const Device& device, VkCommandBuffer commands, VkPipeline kernel,
                      const Bindings& bindings, const Slice& slice, const DispatchArguments& arguments) {
  setUp(device, commands, kernel, bindings, slice);
  device.api().vkCmdDispatchIndirect(commands, arguments.buffer, arguments.offset);
}

void clearBefore(const Device& device, VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize bytes) {
  device.api().vkCmdFillBuffer(commands, buffer, 0, bytes, 0);
  auto order = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  order.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  order.dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  device.api().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &order, 0, nullptr, 0,
                                    nullptr);
}

void orderShaders(const Device& device, VkCommandBuffer commands) {
  auto order = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  order.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  order.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
  device.api().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                    VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &order, 0, nullptr, 0,
                                    nullptr);
}

}  // namespace vorpipe::vulkan
