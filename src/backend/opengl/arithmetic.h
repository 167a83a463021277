/// Computes with the caller's numbers.
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

  /// Implements Backend::compute. Requires a complete framebuffer to be bound, and leaves it unchanged.
  /// Errors (device): the device failed; the driver refuses the shader.
  Result<void> run(std::span<const Operands> operands, std::span<Computed> out);

 private:
  Program program_;
  GLuint attributes_ = 0;
  Buffer operands_;
  Feedback feedback_;
};

}  // namespace vorpipe::opengl
