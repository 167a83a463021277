/// A window's events, for Dear ImGui.
#pragma once

#include <deque>
#include <vector>

#include "view/window/event.h"

namespace vorpipe::view {

/// Hands events to Dear ImGui's context: in one frame as many as it tells apart, so that a press is seen
/// before its release.
class Feed {
 public:
  void take(const Event& event) { events_.push_back(event); }
  /// Before a frame: hands over what it is to see. Whether there was any.
  bool next();

 private:
  std::deque<Event> events_;
  std::vector<int> held_;  ///< keys that are to be released again
};

}  // namespace vorpipe::view
