/// Records how long the driver takes to make pipelines.
#pragma once

#include <volk.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::vulkan {

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

}  // namespace vorpipe::vulkan
