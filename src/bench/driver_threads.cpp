#include "bench/driver_threads.h"

#include <cstdlib>
#include <string>

#include "base/parallel.h"

namespace vorpipe {
namespace {

constexpr const char* variable = "LP_NUM_THREADS";

/// The driver gives each of its threads an equal part of a dispatch, and waits for the last. If all
/// processors are requested, two threads for each let the system put more of them on idle processors.
int threadsFor(int processors) {
  const int wanted = threadCount(processors);
  return wanted == 1 || wanted < threadCount(0) ? wanted : 2 * wanted;
}

}  // namespace

void setDriverThreads(int processors) {
  // Decision D122. Drivers look machine code up in their cache whatever its lanes, and code for eight lanes
  // writes past the end of vertices for four.
  constexpr int keep = 0;
  if (std::getenv("LP_NATIVE_VECTOR_WIDTH") != nullptr) setenv("MESA_SHADER_CACHE_DISABLE", "true", keep);
  static const bool is_users = std::getenv(variable) != nullptr;
  constexpr int replace = 1;
  if (!is_users) setenv(variable, std::to_string(threadsFor(processors)).c_str(), replace);
}

}  // namespace vorpipe
