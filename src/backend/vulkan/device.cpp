#include "backend/vulkan/device.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "backend/vulkan/error.h"
#include "backend/vulkan/handle.h"
#include "base/stopwatch.h"
#include "base/try.h"

namespace vorpipe::vulkan {
namespace {

constexpr std::uint32_t ends = 2;
constexpr std::uint32_t word_bits = 64;
constexpr double seconds_per_nanosecond = 1e-9;

}  // namespace

Result<Clock> Clock::create(const Physical& physical, VkDevice device, const VolkDeviceTable& api) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical.handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical.handle, &count, families.data());
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical.handle, &properties);
  const std::uint32_t bits = families.at(physical.queue_family).timestampValidBits;
  Clock clock;
  if (bits == 0) return clock;
  clock.valid_ = bits >= word_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  clock.seconds_per_tick_ = seconds_per_nanosecond * static_cast<double>(properties.limits.timestampPeriod);
  auto info = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = ends;
  VORPIPE_VAR(
      pool, vulkan::create(device, api.vkCreateQueryPool, api.vkDestroyQueryPool, info, "vkCreateQueryPool"));
  clock.pool_ = std::move(pool);
  return clock;
}

void Clock::begin(const VolkDeviceTable& api, VkCommandBuffer commands) const {
  if (!pool_) return;
  api.vkCmdResetQueryPool(commands, pool_.get(), 0, ends);
  api.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, pool_.get(), 0);
}

void Clock::end(const VolkDeviceTable& api, VkCommandBuffer commands) const {
  if (pool_) api.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_.get(), 1);
}

Result<void> Clock::take(VkDevice device, const VolkDeviceTable& api) {
  if (!pool_) return {};
  std::array<std::uint64_t, ends> ticks{};
  VORPIPE_TRY(
      check(api.vkGetQueryPoolResults(device, pool_.get(), 0, ends, sizeof(ticks), ticks.data(),
                                      sizeof(ticks[0]), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
            "vkGetQueryPoolResults"));
  seconds_ += static_cast<double>((ticks[1] - ticks[0]) & valid_) * seconds_per_tick_;
  return {};
}

namespace {

constexpr auto long_time = std::chrono::seconds(3);

/// Calls `late` if this lives longer than long_time.
class Watch {
 public:
  explicit Watch(std::function<void()> late) {
    try {
      thread_ = std::jthread([this, late = std::move(late)](const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        over_.wait_for(lock, stop, long_time, [] { return false; });
        if (!stop.stop_requested()) late();
      });
    } catch (const std::system_error&) {
      // The system refused a thread: `late` is not called, and the pipeline is made all the same.
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any over_;
  std::jthread thread_;
};

}  // namespace

VkResult PipelineLog::time(std::string_view name, const std::function<VkResult()>& make) {
  const Stopwatch stopwatch;
  VkResult result = VK_SUCCESS;
  if (waiting_ && !told_) {
    const Watch watch([&] {
      told_ = true;
      waiting_("the driver of " + device_ + " has been compiling the shader " + std::string(name) + " for " +
               std::to_string(long_time.count()) + " s");
    });
    result = make();
  } else {
    result = make();
  }
  const std::lock_guard lock(mutex_);
  if (result == VK_SUCCESS) made_.push_back({std::string(name), stopwatch.milliseconds()});
  return result;
}

std::vector<PipelineTime> PipelineLog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(made_, {});
}

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
    VORPIPE_VAR(clock, Clock::create(physical, device.device_, *device.api_));
    device.clock_ = std::move(clock);
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
  VORPIPE_VAR(pool, create(device_, api_->vkCreateCommandPool, api_->vkDestroyCommandPool, pool_info,
                           "vkCreateCommandPool"));
  pool_ = std::move(pool);
  auto commands_info = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  commands_info.commandPool = pool_.get();
  commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands_info.commandBufferCount = 1;
  VORPIPE_TRY(
      check(api_->vkAllocateCommandBuffers(device_, &commands_info, &commands_), "vkAllocateCommandBuffers"));
  const auto fence_info = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  VORPIPE_VAR(fence, create(device_, api_->vkCreateFence, api_->vkDestroyFence, fence_info, "vkCreateFence"));
  done_ = std::move(fence);
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

Result<Handle<VkShaderModule>> shaderModule(const Device& device, const shaders::Spirv& spirv) {
  const auto code = device.unrolled() ? spirv.unrolled : spirv.rolled;
  auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  return create(device.handle(), device.api().vkCreateShaderModule, device.api().vkDestroyShaderModule, info,
                "vkCreateShaderModule");
}

}  // namespace vorpipe::vulkan
