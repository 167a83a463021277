#include "backend/cpu/grid_lanes.h"
#include "base/lane_width.h"

namespace vorpipe::cpu {

// Compiled from grid_lanes.cpp; see CMakeLists.txt.
void findIn4Lanes(const LaneJob& job, bool large);
void findWeightedIn4Lanes(const LaneJob& job, bool large);
#ifdef VORPIPE_WIDE_LANES
void findIn8Lanes(const LaneJob& job, bool large);
void findWeightedIn8Lanes(const LaneJob& job, bool large);
void findIn16Lanes(const LaneJob& job, bool large);
void findWeightedIn16Lanes(const LaneJob& job, bool large);
#endif

FindInLanes findInLanes(bool weighted) {
#ifdef VORPIPE_WIDE_LANES
  if (laneWidth() >= 16) return weighted ? findWeightedIn16Lanes : findIn16Lanes;
  if (laneWidth() >= 8) return weighted ? findWeightedIn8Lanes : findIn8Lanes;
#endif
  return weighted ? findWeightedIn4Lanes : findIn4Lanes;
}

}  // namespace vorpipe::cpu
