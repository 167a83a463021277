/// Connects Dear ImGui to a window: events, the font's texture, and triangles.
#pragma once

#include <deque>
#include <vector>

#include "view/window/event.h"
#include "view/window/presenter.h"

namespace vorpipe::view {

/// Passes events to Dear ImGui's context: per frame only as many as ImGui can distinguish, so that it sees a
/// press before its release.
class InputQueue {
 public:
  void take(const Event& event) { events_.push_back(event); }
  /// Call before a frame: passes the frame's events, and returns whether there were any.
  bool next();

 private:
  std::deque<Event> events_;
  std::vector<int> held_;  ///< keys to release in the next frame
};

/// Draws the font at a scale into the texture of Dear ImGui's context, and returns it.
PanelTexture drawFont(double scale);

/// Takes the triangles of the last frame of Dear ImGui's context, for a window of width x height pixels.
void takeTriangles(int width, int height, PanelTriangles& triangles);

}  // namespace vorpipe::view
