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

/// What the viewer needs of a window, so that tests can run without one. Call everything except wake() on the
/// thread that opened the window.
class Screen {
 public:
  virtual ~Screen() = default;

  /// Returns the events since the last call. With `seconds` above 0, waits at most that long for an event; it
  /// may return earlier without any. A Resize to the present size means that the desktop has lost part of the
  /// window's contents. A key that gives a character yields a Key, then a Text.
  virtual std::vector<Event> events(double seconds) = 0;
  virtual void wake() = 0;  ///< ends a wait; call from any thread

  /// Applies a script's event to the window itself: Resize, Minimize, Restore, Close. Each comes back as an
  /// event: Close at once, the others when the desktop has done them. Without a window manager, no window is
  /// minimized.
  virtual void apply(const Event& event) = 0;

  /// In pixels of the framebuffer; 0 x 0 while it is minimized.
  [[nodiscard]] virtual int width() const = 0;
  [[nodiscard]] virtual int height() const = 0;
  /// The desktop's scale for letters and all that is pointed at: 2 if pixels are half the usual size.
  [[nodiscard]] virtual double scale() const { return 1; }
  virtual void setTitle(const std::string& title) = 0;
  virtual void copyToClipboard(const std::string& text) = 0;

  [[nodiscard]] virtual Presenter& presenter() = 0;
};

class Window final : public Screen {
 public:
  /// Errors (device), in one line: GLFW's library, a display, or what `api` needs is missing.
  static Result<Window> open(const WindowOptions& options);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window() override;

  std::vector<Event> events(double seconds) override;
  void wake() override;
  void apply(const Event& event) override;
  [[nodiscard]] int width() const override;
  [[nodiscard]] int height() const override;
  [[nodiscard]] double scale() const override;
  void setTitle(const std::string& title) override;
  void copyToClipboard(const std::string& text) override;
  [[nodiscard]] Presenter& presenter() override;

 private:
  Window();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::view
