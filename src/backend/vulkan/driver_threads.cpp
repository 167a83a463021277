#include "backend/vulkan/driver_threads.h"

#include <cstdlib>
#include <string>

#include "parallel.h"

namespace vorpipe::vulkan {
namespace {

constexpr const char* variable = "LP_NUM_THREADS";

/// The driver gives each of its threads an equal part of a dispatch, and waits for the last. Where all
/// processors are asked for, two threads for each let the system put more of them on those that have nothing
/// else to do.
int threadsFor(int processors) {
  const int wanted = threadCount(processors);
  return wanted == 1 || wanted < threadCount(0) ? wanted : 2 * wanted;
}

}  // namespace

DriverThreads::DriverThreads(int processors) {
  const auto threads = std::to_string(threadsFor(processors));
  set_ = std::getenv(variable) == nullptr && setenv(variable, threads.c_str(), 0) == 0;
}

DriverThreads::~DriverThreads() {
  if (set_) unsetenv(variable);
}

}  // namespace vorpipe::vulkan
