/// An opened device with its queue and the means to run commands on it.
#pragma once

#include <volk.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "backend/vulkan/clock.h"
#include "backend/vulkan/handle.h"
#include "backend/vulkan/physical.h"
#include "backend/vulkan/pipeline_log.h"
#include "vorpipe.h"

namespace vorpipe::vulkan {

/// What commands wait for, and what they signal when they are done. The host waits for the commands in any
/// case; semaphores serve to pass images without the host.
struct Semaphores {
  VkSemaphore before = VK_NULL_HANDLE;    ///< null: nothing
  VkPipelineStageFlags before_stage = 0;  ///< the stage of the commands that waits
  VkSemaphore after = VK_NULL_HANDLE;     ///< null: nothing
};

class Device {
 public:
  /// Opens a usable device with exactly the features that the pipelines need, and with these extensions.
  static Result<Device> open(const Physical& physical, std::span<const char* const> extensions = {});
  Device(Device&& other) noexcept;
  Device& operator=(Device&&) = delete;
  ~Device();

  [[nodiscard]] VkDevice handle() const { return device_; }
  [[nodiscard]] const VolkDeviceTable& api() const { return *api_; }
  [[nodiscard]] VkQueue queue() const { return queue_; }
  [[nodiscard]] const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
  /// Whether the device gets shaders with unrolled loops.
  [[nodiscard]] bool unrolled() const { return unrolled_; }
  /// Every pipeline of the device is made through this.
  [[nodiscard]] PipelineLog& pipelines() const { return *pipelines_; }
  /// In bytes; larger allocations are not worth requesting.
  [[nodiscard]] std::uint64_t largestAllocation() const { return largest_allocation_; }

  /// Runs what `record` writes into a command buffer. Waits until it is done and its results are visible to
  /// the host.
  Result<void> run(const std::function<void(VkCommandBuffer)>& record, const Semaphores& semaphores = {});

  /// Returns how long all of that took by the device's own clock; negative if none is read.
  [[nodiscard]] double seconds() const { return clock_.seconds(); }

 private:
  Device() = default;
  Result<void> prepare(std::uint32_t queue_family);

  VkDevice device_ = VK_NULL_HANDLE;
  std::unique_ptr<VolkDeviceTable> api_ = std::make_unique<VolkDeviceTable>();
  VkPhysicalDeviceMemoryProperties memory_{};
  std::uint64_t largest_allocation_ = 0;
  bool unrolled_ = false;
  std::unique_ptr<PipelineLog> pipelines_;
  VkQueue queue_ = VK_NULL_HANDLE;
  Handle<VkCommandPool> pool_;
  Handle<VkFence> done_;
  Clock clock_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace vorpipe::vulkan
