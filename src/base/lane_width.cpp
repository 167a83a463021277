#include "base/lane_width.h"

#include <algorithm>
#include <cstdlib>

namespace vorpipe {
namespace {

int supported() {
#if defined(__x86_64__)
  // Some compilers can only query the parts of x86-64-v4.
  const bool avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi2") != 0 &&
                    __builtin_cpu_supports("fma") != 0;
  if (avx2 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
      __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      __builtin_cpu_supports("avx512vl") != 0) {
    return 16;
  }
  if (avx2) return 8;
#endif
  return 4;
}

}  // namespace

int laneWidth() {
  static const int width = [] {
    const char* const wanted = std::getenv("VORPIPE_LANES");
    return wanted == nullptr ? supported() : std::min(supported(), std::atoi(wanted));
  }();
  return width;
}

}  // namespace vorpipe
