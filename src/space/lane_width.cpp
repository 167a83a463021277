#include "base/lane_width.h"

#include "space/corner_lanes.h"
#include "space/polyhedron_lanes.h"

namespace vorpipe::space {

// Compiled from polyhedron_lanes.cpp and corner_lanes.cpp; see CMakeLists.txt.
#define VORPIPE_PROPOSE(name)                                                                 \
  void name(const LaneBins& bins, std::uint32_t bin, std::uint32_t first, std::uint32_t last, \
            void (*take)(void*, std::uint32_t, const ProposedCell&), void* context)
VORPIPE_PROPOSE(proposeIn4Lanes);
VORPIPE_PROPOSE(proposeDoublesIn4Lanes);
void cornersIn4Lanes(CornerJob& job);
#ifdef VORPIPE_WIDE_LANES
VORPIPE_PROPOSE(proposeIn8Lanes);
VORPIPE_PROPOSE(proposeIn16Lanes);
VORPIPE_PROPOSE(proposeDoublesIn8Lanes);
VORPIPE_PROPOSE(proposeDoublesIn16Lanes);
void cornersIn8Lanes(CornerJob& job);
void cornersIn16Lanes(CornerJob& job);
#endif

ProposeCells proposeCells(Precision precision) {
  const bool in_float = precision == Precision::in_float;
#ifdef VORPIPE_WIDE_LANES
  if (laneWidth() >= 16) return in_float ? proposeIn16Lanes : proposeDoublesIn16Lanes;
  if (laneWidth() >= 8) return in_float ? proposeIn8Lanes : proposeDoublesIn8Lanes;
#endif
  return in_float ? proposeIn4Lanes : proposeDoublesIn4Lanes;
}

FindCorners findCorners() {
#ifdef VORPIPE_WIDE_LANES
  if (laneWidth() >= 16) return cornersIn16Lanes;
  if (laneWidth() >= 8) return cornersIn8Lanes;
#endif
  return cornersIn4Lanes;
}

}  // namespace vorpipe::space
