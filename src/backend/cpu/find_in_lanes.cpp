#include <cstdlib>

#include "backend/cpu/grid_lanes.h"

namespace vorpipe::cpu {

// Compiled from grid_lanes.cpp; see CMakeLists.txt.
void findIn4Lanes(const LaneJob& job, bool large);
void findWeightedIn4Lanes(const LaneJob& job, bool large);
#ifdef VORPIPE_WIDE_LANES
void findIn8Lanes(const LaneJob& job, bool large);
void findWeightedIn8Lanes(const LaneJob& job, bool large);
void findIn16Lanes(const LaneJob& job, bool large);
void findWeightedIn16Lanes(const LaneJob& job, bool large);

namespace {

/// Returns the largest width to use, from VORPIPE_LANES: tests compare the results of different widths on one
/// machine.
int widestWanted() {
  const char* const text = std::getenv("VORPIPE_LANES");
  return text == nullptr ? 16 : std::atoi(text);
}

/// Whether the processor supports x86-64-v4; some compilers can only query its parts.
bool hasAvx512() {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi2") != 0 &&
         __builtin_cpu_supports("fma") != 0 && __builtin_cpu_supports("avx512f") != 0 &&
         __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
         __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
}

}  // namespace
#endif

FindInLanes findInLanes(bool weighted) {
#ifdef VORPIPE_WIDE_LANES
  static const int widest = widestWanted();
  if (widest >= 16 && hasAvx512()) {
    return weighted ? findWeightedIn16Lanes : findIn16Lanes;
  }
  if (widest >= 8 && __builtin_cpu_supports("avx2") != 0) {
    return weighted ? findWeightedIn8Lanes : findIn8Lanes;
  }
#endif
  return weighted ? findWeightedIn4Lanes : findIn4Lanes;
}

}  // namespace vorpipe::cpu
