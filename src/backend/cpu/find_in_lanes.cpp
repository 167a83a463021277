#include "backend/cpu/grid_lanes.h"

namespace vorpipe::cpu {

// grid_lanes.cpp, as CMakeLists.txt compiles it.
void findIn4Lanes(const LaneJob& job, bool roomy);
#ifdef VORPIPE_WIDE_LANES
void findIn8Lanes(const LaneJob& job, bool roomy);
#endif

FindInLanes findInLanes() {
#ifdef VORPIPE_WIDE_LANES
  if (__builtin_cpu_supports("avx2") != 0) return findIn8Lanes;
#endif
  return findIn4Lanes;
}

}  // namespace vorpipe::cpu
