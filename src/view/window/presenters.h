/// The two ways to show something in a window.
#pragma once

#include <memory>
#include <string>

#include "view/window/glfw.h"
#include "view/window/presenter.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

/// For a window that was made without a graphics interface. `device` is as BackendOptions::device. The
/// presenter goes before the window.
Result<std::unique_ptr<Presenter>> makeVulkanPresenter(const Glfw& glfw, GLFWwindow* window,
                                                       const std::string& device, bool validation);

/// For a window that has an OpenGL 4.1 context.
Result<std::unique_ptr<Presenter>> makeOpenglPresenter(const Glfw& glfw, GLFWwindow* window);

}  // namespace vorpipe::view
