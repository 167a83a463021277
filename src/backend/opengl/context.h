/// OpenGL contexts without a window: the only part of this backend that differs by platform.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::opengl {

/// While it lives, a context is current on the thread that entered it. Afterwards the thread's previous
/// context is current again.
class Scope {
 public:
  explicit Scope(std::function<void()> leave) : leave_(std::move(leave)) {}
  Scope(Scope&& other) noexcept : leave_(std::exchange(other.leave_, nullptr)) {}
  Scope& operator=(Scope&&) = delete;
  ~Scope() {
    if (leave_) leave_();
  }

 private:
  std::function<void()> leave_;
};

/// An OpenGL 4.1 core context. It owns every GL object that is made in it: they are destroyed with it.
class Context {
 public:
  struct Native;  ///< the platform's part, in context_egl.cpp or context_cgl.cpp
  explicit Context(std::unique_ptr<Native> native);
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;
  ~Context();

  /// Makes the context current on the calling thread. Error (device): the system refuses.
  [[nodiscard]] Result<Scope> enter() const;

 private:
  std::unique_ptr<Native> native_;
};

/// Opens a context on each device, in the system's order; an element is an error if a device provides none.
/// If only hardware is wanted, omits devices that the system itself calls software. Error (device): OpenGL
/// without a display is not available here, or not from the wanted drivers.
Result<std::vector<Result<Context>>> openContexts(Drivers drivers);

}  // namespace vorpipe::opengl
