#include "view/window/window.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "base/try.h"
#include "view/window/window_parts.h"

namespace vorpipe::view {

struct Window::State {
  std::shared_ptr<const Glfw> glfw{};
  GLFWwindow* window = nullptr;
  Input input{};
  std::unique_ptr<Presenter> presenter{};

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    presenter.reset();
    if (window != nullptr) glfw->destroyWindow(window);
  }

  [[nodiscard]] std::pair<int, int> size() const {
    int width = 0, height = 0;
    if (!input.minimized) glfw->getFramebufferSize(window, &width, &height);
    return {width, height};
  }
};

namespace {

// Sessions create their contexts by EGL too; a GLX context current on the same thread would conflict.
void askForOpengl(const Glfw& glfw) {
  glfw.windowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
#ifndef __APPLE__
  glfw.windowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
#endif
  glfw.windowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfw.windowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
  glfw.windowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfw.windowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfw.windowHint(GLFW_ALPHA_BITS, 0);
  glfw.windowHint(GLFW_DEPTH_BITS, 0);
  glfw.windowHint(GLFW_STENCIL_BITS, 0);
}

Result<GLFWwindow*> createWindow(const Glfw& glfw, const WindowOptions& options) {
  const bool opengl = options.api == WindowApi::opengl;
  glfw.windowHintString(GLFW_X11_CLASS_NAME, "vorpipe");
  glfw.windowHintString(GLFW_X11_INSTANCE_NAME, "vorpipe");
  glfw.windowHint(GLFW_CLIENT_API, GLFW_NO_API);
  if (opengl) askForOpengl(glfw);
  GLFWwindow* const window =
      glfw.createWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  if (window != nullptr) return window;
  const std::string why = glfw.lastError();
  return tl::unexpected(Error{ErrorCode::device, opengl ? fmt::format("no window with OpenGL 4.1: {}", why)
                                                        : fmt::format("no window on this display: {}", why)});
}

}  // namespace

Window::Window() : state_(std::make_unique<State>()) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::open(const WindowOptions& options) {
  Window opened;
  State& state = *opened.state_;
  VORPIPE_VAR(glfw, Glfw::start());
  state.glfw = std::move(glfw);
  state.input.glfw = state.glfw.get();
  VORPIPE_LET(window, createWindow(*state.glfw, options));
  state.window = window;
  listen(state.window, state.input);
  VORPIPE_VAR(presenter,
              options.api == WindowApi::vulkan
                  ? makeVulkanPresenter(*state.glfw, state.window, options.device, options.validation)
                  : makeOpenglPresenter(*state.glfw, state.window));
  state.presenter = std::move(presenter);
  return opened;
}

std::vector<Event> Window::events(double seconds) {
  const Glfw& glfw = *state_->glfw;
  // Events from an earlier GLFW call are delivered without waiting.
  if (!(seconds > 0) || !state_->input.events.empty()) {
    glfw.pollEvents();
  } else if (std::isinf(seconds)) {
    glfw.waitEvents();
  } else {
    glfw.waitEventsTimeout(seconds);
  }
  return std::exchange(state_->input.events, {});
}

void Window::wake() { state_->glfw->postEmptyEvent(); }

void Window::apply(const Event& event) {
  const Glfw& glfw = *state_->glfw;
  if (const auto* const size = std::get_if<Resize>(&event)) {
    int width = 0, height = 0, pixels_wide = 0, pixels_high = 0;
    glfw.getWindowSize(state_->window, &width, &height);
    glfw.getFramebufferSize(state_->window, &pixels_wide, &pixels_high);
    const auto inUnits = [](int pixels, int units, int framebuffer) {
      return framebuffer > 0 ? static_cast<int>(std::lround(1.0 * pixels * units / framebuffer)) : pixels;
    };
    glfw.setWindowSize(state_->window, inUnits(size->width, width, pixels_wide),
                       inUnits(size->height, height, pixels_high));
  } else if (std::holds_alternative<Minimize>(event)) {
    glfw.iconifyWindow(state_->window);
  } else if (std::holds_alternative<Restore>(event)) {
    glfw.restoreWindow(state_->window);
  } else if (std::holds_alternative<Close>(event)) {
    state_->input.events.emplace_back(Close{});
  }
}

int Window::width() const { return state_->size().first; }

int Window::height() const { return state_->size().second; }

double Window::scale() const {
  float x = 1, y = 1;
  state_->glfw->getWindowContentScale(state_->window, &x, &y);
  // Some desktops do not report a scale.
  return x > 0 ? std::clamp(static_cast<double>(x), 0.5, 8.0) : 1;
}

void Window::setTitle(const std::string& title) {
  state_->glfw->setWindowTitle(state_->window, title.c_str());
}

void Window::copyToClipboard(const std::string& text) {
  state_->glfw->setClipboardString(state_->window, text.c_str());
}

Presenter& Window::presenter() { return *state_->presenter; }

}  // namespace vorpipe::view
