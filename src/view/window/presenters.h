/// The two presenters.
#pragma once

#include <memory>
#include <string>

#include "view/window/glfw.h"
#include "view/window/presenter.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

/// For a window created without a graphics API. `device` is as in BackendOptions::device. Destroy the
/// presenter before the window.
Result<std::unique_ptr<Presenter>> makeVulkanPresenter(const Glfw& glfw, GLFWwindow* window,
                                                       const std::string& device, bool validation);

/// For a window with an OpenGL 4.1 context.
Result<std::unique_ptr<Presenter>> makeOpenglPresenter(const Glfw& glfw, GLFWwindow* window);

}  // namespace vorpipe::view
