#include "backend/vulkan/device.h"

#include <limits>
#include <string>
#include <vector>

#include "backend/vulkan/error.h"
#include "backend/vulkan/structure.h"

namespace vorpipe::vulkan {

Result<Device> Device::open(const Physical& physical, std::span<const char* const> wanted) {
  const float priority = 1.0F;
  auto queue = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = physical.queue_family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceFeatures features{};
  features.geometryShader = physical.capabilities.geometry_shader ? VK_TRUE : VK_FALSE;
  features.vertexPipelineStoresAndAtomics =
      physical.capabilities.vertex_pipeline_stores_and_atomics ? VK_TRUE : VK_FALSE;
  std::vector<const char*> extensions(wanted.begin(), wanted.end());
  if (physical.portability_subset) extensions.push_back("VK_KHR_portability_subset");
  auto info = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.pEnabledFeatures = &features;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  Device device;
  VORPIPE_TRY(check(vkCreateDevice(physical.handle, &info, nullptr, &device.device_),
                    "vkCreateDevice of '" + physical.info.name + "'"));
  volkLoadDeviceTable(device.api_.get(), device.device_);
  vkGetPhysicalDeviceMemoryProperties(physical.handle, &device.memory_);
  device.largest_allocation_ = physical.capabilities.max_memory_allocation_size;
  device.unrolled_ = physical.capabilities.unrolled_shaders;
  device.pipelines_ = std::make_unique<PipelineLog>(physical.info.name, physical.waiting);
  VORPIPE_TRY(device.prepare(physical.queue_family));
  // A software device's timestamps come from its rasterizer, which other work does not pass through. The host
  // waits for such a device while it works, and can measure that time itself.
  if (physical.info.type != "cpu") {
    Result<Clock> clock = Clock::create(physical, device.device_, *device.api_);
    if (!clock) return tl::unexpected(std::move(clock).error());
    device.clock_ = std::move(*clock);
  }
  return device;
}

Device::Device(Device&& other) noexcept
    : device_(std::exchange(other.device_, VK_NULL_HANDLE)),
      api_(std::move(other.api_)),
      memory_(other.memory_),
      largest_allocation_(other.largest_allocation_),
      unrolled_(other.unrolled_),
      pipelines_(std::move(other.pipelines_)),
      queue_(other.queue_),
      pool_(std::move(other.pool_)),
      done_(std::move(other.done_)),
      clock_(std::move(other.clock_)),
      commands_(other.commands_) {}

Device::~Device() {
  if (device_ == VK_NULL_HANDLE) return;
  clock_ = {};
  done_ = {};
  pool_ = {};
  api_->vkDestroyDevice(device_, nullptr);
}

Result<void> Device::prepare(std::uint32_t queue_family) {
  api_->vkGetDeviceQueue(device_, queue_family, 0, &queue_);
  auto pool_info = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool_info.queueFamilyIndex = queue_family;
  Result<Handle<VkCommandPool>> pool = create(device_, api_->vkCreateCommandPool, api_->vkDestroyCommandPool,
                                              pool_info, "vkCreateCommandPool");
  if (!pool) return tl::unexpected(std::move(pool).error());
  pool_ = std::move(*pool);
  auto commands_info = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  commands_info.commandPool = pool_.get();
  commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands_info.commandBufferCount = 1;
  VORPIPE_TRY(
      check(api_->vkAllocateCommandBuffers(device_, &commands_info, &commands_), "vkAllocateCommandBuffers"));
  const auto fence_info = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  Result<Handle<VkFence>> fence =
      create(device_, api_->vkCreateFence, api_->vkDestroyFence, fence_info, "vkCreateFence");
  if (!fence) return tl::unexpected(std::move(fence).error());
  done_ = std::move(*fence);
  return {};
}

Result<void> Device::run(const std::function<void(VkCommandBuffer)>& record, const Semaphores& semaphores) {
  VORPIPE_TRY(check(api_->vkResetCommandPool(device_, pool_.get(), 0), "vkResetCommandPool"));
  auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  VORPIPE_TRY(check(api_->vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer"));
  clock_.begin(*api_, commands_);
  record(commands_);
  auto for_host = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  for_host.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  for_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  api_->vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                             &for_host, 0, nullptr, 0, nullptr);
  clock_.end(*api_, commands_);
  VORPIPE_TRY(check(api_->vkEndCommandBuffer(commands_), "vkEndCommandBuffer"));
  auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  submit.waitSemaphoreCount = semaphores.before != VK_NULL_HANDLE ? 1 : 0;
  submit.pWaitSemaphores = &semaphores.before;
  submit.pWaitDstStageMask = &semaphores.before_stage;
  submit.signalSemaphoreCount = semaphores.after != VK_NULL_HANDLE ? 1 : 0;
  submit.pSignalSemaphores = &semaphores.after;
  const VkFence fence = done_.get();
  VORPIPE_TRY(check(api_->vkResetFences(device_, 1, &fence), "vkResetFences"));
  VORPIPE_TRY(check(api_->vkQueueSubmit(queue_, 1, &submit, fence), "vkQueueSubmit"));
  const VkResult waited =
      api_->vkWaitForFences(device_, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
  // The caller destroys what the submitted commands use. After a failed wait they may still run.
  if (waited != VK_SUCCESS) api_->vkDeviceWaitIdle(device_);
  VORPIPE_TRY(check(waited, "vkWaitForFences"));
  return clock_.take(device_, *api_);
}

}  // namespace vorpipe::vulkan
