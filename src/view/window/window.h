/// A desktop window, by GLFW, which is loaded with the first window.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "view/window/event.h"
#include "view/window/presenter.h"
#include "vorpipe/result.h"

namespace vorpipe::view {

struct WindowOptions {
  std::string title = "vorpipe";
  int width = 1280, height = 720;
  WindowApi api = WindowApi::vulkan;
  std::string device;       ///< the presenting Vulkan device, as in BackendOptions::device
  bool validation = false;  ///< turns on Vulkan's validation layers
};

/// Call everything except wake() on the thread that opened the window.
class Window {
 public:
  /// Errors (device), in one line: GLFW's library, a display, or what `api` needs is missing.
  static Result<Window> open(const WindowOptions& options);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// Returns the events since the last call. With `seconds` above 0, waits at most that long for an event; it
  /// may return earlier without any. A Resize to the present size means that the desktop has lost part of the
  /// window's contents. A key that gives a character yields a Key, then a Text.
  std::vector<Event> events(double seconds);
  /// Ends a wait; call from any thread.
  void wake();

  /// Applies a script's event to the window itself: Resize, Minimize, Restore, Close. Each comes back as an
  /// event: Close at once, the others when the desktop has done them. Without a window manager, no window is
  /// minimized.
  void apply(const Event& event);

  /// In pixels of the framebuffer; 0 x 0 while it is minimized.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  /// The desktop's scale for letters and all that is pointed at: 2 if pixels are half the usual size.
  [[nodiscard]] double scale() const;
  void setTitle(const std::string& title);
  void copyToClipboard(const std::string& text);

  [[nodiscard]] Presenter& presenter();

 private:
  Window();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::view
