/// A window of the desktop, by GLFW, which is loaded when the first one is opened.
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
  std::string device;       ///< what presents, by Vulkan: as BackendOptions::device
  bool validation = false;  ///< Vulkan's layers
};

/// All calls but wake() are of the thread that opened it.
class Window {
 public:
  /// Errors (device): GLFW's library, a display, or what `api` needs is missing, in one line.
  static Result<Window> open(const WindowOptions& options);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// What happened since the last call. With `seconds` above 0 it waits until something does, or so long; it
  /// may return earlier without any. A Resize to the size that the window has means that the desktop has lost
  /// what a part of it showed. A key that gives a character comes as Key, then as Text.
  std::vector<Event> events(double seconds);
  /// Ends a wait; from any thread.
  void wake();

  /// Does what a script says about the window itself: Resize, Minimize, Restore, Close. They come back as
  /// events, Close at once, the others when the desktop has done them: without a window manager none is
  /// minimized.
  void apply(const Event& event);

  /// In pixels of the framebuffer; 0 x 0 while it is minimized.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  /// Of letters and all that is pointed at: 2 where pixels are half as large as usual, by the desktop's
  /// setting.
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
