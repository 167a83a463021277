/// OpenGL contexts without a window: the one concern of this backend that differs by platform.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "backend/backend.h"

namespace vorpipe::opengl {

/// While it lives, a context is current on the thread that entered it; afterwards that thread is
/// back at what was current before.
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

/// An OpenGL 4.1 core context. It owns every GL object that is made in it: they go when it goes.
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

/// Opens a context on each device, in the system's order; an element is an error where a device
/// gives none. Where only hardware is wanted, devices that the system itself calls software are left out.
/// Error (device): there is no OpenGL without a display here at all, or none of the drivers wanted.
Result<std::vector<Result<Context>>> openContexts(Drivers drivers);

}  // namespace vorpipe::opengl
