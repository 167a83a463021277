/// GLFW's functions. The library is loaded with the first window, so programs start without it.
#pragma once

#include <volk.h>
// GLFW declares its Vulkan functions only if Vulkan's header comes before.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <memory>
#include <string>

#include "vorpipe/result.h"

/// Calls USE(member, function) for each function that is used.
#define VORPIPE_GLFW_FUNCTIONS(USE)                                     \
  USE(init, glfwInit)                                                   \
  USE(terminate, glfwTerminate)                                         \
  USE(getError, glfwGetError)                                           \
  USE(windowHint, glfwWindowHint)                                       \
  USE(windowHintString, glfwWindowHintString)                           \
  USE(createWindow, glfwCreateWindow)                                   \
  USE(destroyWindow, glfwDestroyWindow)                                 \
  USE(setWindowUserPointer, glfwSetWindowUserPointer)                   \
  USE(getWindowUserPointer, glfwGetWindowUserPointer)                   \
  USE(setWindowShouldClose, glfwSetWindowShouldClose)                   \
  USE(setWindowTitle, glfwSetWindowTitle)                               \
  USE(setWindowSize, glfwSetWindowSize)                                 \
  USE(getWindowSize, glfwGetWindowSize)                                 \
  USE(getFramebufferSize, glfwGetFramebufferSize)                       \
  USE(getWindowContentScale, glfwGetWindowContentScale)                 \
  USE(iconifyWindow, glfwIconifyWindow)                                 \
  USE(restoreWindow, glfwRestoreWindow)                                 \
  USE(setClipboardString, glfwSetClipboardString)                       \
  USE(pollEvents, glfwPollEvents)                                       \
  USE(waitEvents, glfwWaitEvents)                                       \
  USE(waitEventsTimeout, glfwWaitEventsTimeout)                         \
  USE(postEmptyEvent, glfwPostEmptyEvent)                               \
  USE(getKey, glfwGetKey)                                               \
  USE(getKeyName, glfwGetKeyName)                                       \
  USE(setKeyCallback, glfwSetKeyCallback)                               \
  USE(setCharCallback, glfwSetCharCallback)                             \
  USE(setCursorPosCallback, glfwSetCursorPosCallback)                   \
  USE(setMouseButtonCallback, glfwSetMouseButtonCallback)               \
  USE(setScrollCallback, glfwSetScrollCallback)                         \
  USE(setDropCallback, glfwSetDropCallback)                             \
  USE(setWindowCloseCallback, glfwSetWindowCloseCallback)               \
  USE(setWindowIconifyCallback, glfwSetWindowIconifyCallback)           \
  USE(setWindowRefreshCallback, glfwSetWindowRefreshCallback)           \
  USE(setFramebufferSizeCallback, glfwSetFramebufferSizeCallback)       \
  USE(setWindowContentScaleCallback, glfwSetWindowContentScaleCallback) \
  USE(getCurrentContext, glfwGetCurrentContext)                         \
  USE(makeContextCurrent, glfwMakeContextCurrent)                       \
  USE(swapInterval, glfwSwapInterval)                                   \
  USE(swapBuffers, glfwSwapBuffers)                                     \
  USE(getRequiredInstanceExtensions, glfwGetRequiredInstanceExtensions) \
  USE(createWindowSurface, glfwCreateWindowSurface)

namespace vorpipe::view {

struct Glfw {
  Glfw() = default;
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  ~Glfw();

  /// Loads the library and connects to the display. Windows that are open at the same time share it; it ends
  /// with the last of them. Call on the windows' thread. Errors (device): there is no such library, or no
  /// display.
  static Result<std::shared_ptr<const Glfw>> start();

  /// Returns GLFW's last error message, in one line.
  [[nodiscard]] std::string lastError() const;

#define VORPIPE_GLFW_MEMBER(member, function) decltype(&(function)) member = nullptr;
  VORPIPE_GLFW_FUNCTIONS(VORPIPE_GLFW_MEMBER)
#undef VORPIPE_GLFW_MEMBER

 private:
  bool started_ = false;
};

}  // namespace vorpipe::view
