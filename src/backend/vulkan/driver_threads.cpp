#include "backend/vulkan/driver_threads.h"

#include <cstdlib>
#include <string>

namespace vorpipe::vulkan {
namespace {

constexpr const char* variable = "LP_NUM_THREADS";

}  // namespace

DriverThreads::DriverThreads(int threads) {
  if (threads <= 0) return;
  set_ = std::getenv(variable) == nullptr && setenv(variable, std::to_string(threads).c_str(), 0) == 0;
}

DriverThreads::~DriverThreads() {
  if (set_) unsetenv(variable);
}

}  // namespace vorpipe::vulkan
