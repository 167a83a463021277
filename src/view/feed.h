/// Passes a window's events to Dear ImGui.
#pragma once

#include <deque>
#include <vector>

#include "view/window/event.h"

namespace vorpipe::view {

/// Passes events to Dear ImGui's context: per frame only as many as ImGui can distinguish, so that it sees a
/// press before its release.
class Feed {
 public:
  void take(const Event& event) { events_.push_back(event); }
  /// Call before a frame: passes the frame's events, and returns whether there were any.
  bool next();

 private:
  std::deque<Event> events_;
  std::vector<int> held_;  ///< keys to release in the next frame
};

}  // namespace vorpipe::view
