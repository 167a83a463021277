#include "backend/vulkan/pipeline_log.h"

#include <chrono>
#include <condition_variable>
#include <system_error>
#include <thread>
#include <utility>

#include "base/stopwatch.h"

namespace vorpipe::vulkan {
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

}  // namespace vorpipe::vulkan
