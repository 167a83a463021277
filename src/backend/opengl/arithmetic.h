/// Computing with numbers of the caller's.
#pragma once

#include <span>

#include "backend/backend.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/feedback.h"
#include "backend/opengl/gl.h"
#include "backend/opengl/shader.h"

namespace vorpipe::opengl {

/// A vertex shader whose outputs are captured.
class Calculator {
 public:
  Calculator();

  /// What Backend::compute does. Takes a complete framebuffer that is bound, and leaves it alone. Errors
  /// (device): the device failed; the driver refuses the shader.
  Result<void> run(std::span<const Operands> operands, std::span<Computed> out);

 private:
  Program program_;
  GLuint attributes_ = 0;
  Buffer operands_;
  Feedback feedback_;
};

}  // namespace vorpipe::opengl
