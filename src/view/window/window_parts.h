/// What a Window is made of: its input and its two presenters.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "view/window/event.h"
#include "view/window/glfw.h"
#include "view/window/presenter.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

/// What GLFW reports of a window, as events.
struct Input {
  const Glfw* glfw = nullptr;
  bool minimized = false;
  std::vector<Event> events{};  ///< since the last were taken
};

/// Makes GLFW report a window's input to `input`, which must stay in place as long as the window exists.
void listen(GLFWwindow* window, Input& input);

/// For a window created without a graphics API. `device` is as in BackendOptions::device. Destroy the
/// presenter before the window.
Result<std::unique_ptr<Presenter>> makeVulkanPresenter(const Glfw& glfw, GLFWwindow* window,
                                                       const std::string& device, bool validation);

/// For a window with an OpenGL 4.1 context.
Result<std::unique_ptr<Presenter>> makeOpenglPresenter(const Glfw& glfw, GLFWwindow* window);

}  // namespace vorpipe::view
