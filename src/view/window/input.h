/// Converts GLFW's input of a window to events.
#pragma once

#include <vector>

#include "view/window/event.h"
#include "view/window/glfw.h"

namespace vorpipe::view {

struct Input {
  const Glfw* glfw = nullptr;
  bool minimized = false;
  std::vector<Event> events{};  ///< since the last were taken
};

/// Makes GLFW report a window's input to `input`, which must stay in place as long as the window exists.
void listen(GLFWwindow* window, Input& input);

}  // namespace vorpipe::view
