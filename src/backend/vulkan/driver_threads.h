/// How many threads a driver without a GPU uses.
#pragma once

namespace vorpipe::vulkan {

/// As long as this lives, Mesa's software driver opens devices that keep so many processors busy; with 0, all
/// of them. It sets a variable of the environment, the driver's only way to be told, unless the user has.
class DriverThreads {
 public:
  explicit DriverThreads(int processors);
  ~DriverThreads();
  DriverThreads(const DriverThreads&) = delete;
  DriverThreads& operator=(const DriverThreads&) = delete;

 private:
  bool set_ = false;
};

}  // namespace vorpipe::vulkan
