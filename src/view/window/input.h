/// What GLFW tells of a window, as events.
#pragma once

#include <vector>

#include "view/window/event.h"
#include "view/window/glfw.h"

namespace vorpipe::view {

struct Input {
  const Glfw* glfw = nullptr;
  bool minimized = false;
  std::vector<Event> events{};  ///< since they were taken
};

/// Has GLFW tell a window's input, which stays where it is as long as there is the window.
void listen(GLFWwindow* window, Input& input);

}  // namespace vorpipe::view
