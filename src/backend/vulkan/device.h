/// An opened device with its queue and the means to run commands on it.
#pragma once

#include <volk.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backend/vulkan/handle.h"
#include "backend/vulkan/physical.h"
#include "shaders.h"
#include "vorpipe.h"

namespace vorpipe::vulkan {

class Clock {
 public:
  /// Measures nothing until it is replaced.
  Clock() = default;

  /// Returns the clock of an opened device's queue; it measures nothing if the queue has no timestamps.
  static Result<Clock> create(const Physical& physical, VkDevice device, const VolkDeviceTable& api);

  /// Record the beginning and the end of all work into commands that are submitted once.
  void begin(const VolkDeviceTable& api, VkCommandBuffer commands) const;
  void end(const VolkDeviceTable& api, VkCommandBuffer commands) const;
  /// Adds the time between the two, once the commands are done.
  Result<void> take(VkDevice device, const VolkDeviceTable& api);

  /// Returns the time added so far; negative if this measures nothing.
  [[nodiscard]] double seconds() const { return pool_ ? seconds_ : -1; }

 private:
  Handle<VkQueryPool> pool_;  ///< two timestamps
  std::uint64_t valid_ = 0;   ///< the valid bits of a timestamp
  double seconds_per_tick_ = 0;
  double seconds_ = 0;
};

class PipelineLog {
 public:
  /// `device` is the name of the device in messages. `waiting` is called once, for the first pipeline that
  /// takes more than three seconds.
  PipelineLog(std::string device, Waiting waiting)
      : device_(std::move(device)), waiting_(std::move(waiting)) {}

  /// Calls make, which has the driver make the pipeline of that name, and notes how long it took.
  VkResult time(std::string_view name, const std::function<VkResult()>& make);
  /// Returns the pipelines made since the last call.
  std::vector<PipelineTime> take();

 private:
  std::string device_;
  Waiting waiting_;
  std::mutex mutex_;
  std::vector<PipelineTime> made_;
  std::atomic<bool> told_ = false;
};

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
  static Result<Device> open(const Physical& physical, std::span<const char* const> wanted = {});
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

/// Of SPIR-V, with its loops or without, as the device gets it. Error (device): what Vulkan says.
Result<Handle<VkShaderModule>> shaderModule(const Device& device, const shaders::Spirv& spirv);

}  // namespace vorpipe::vulkan
