/// The pipelines that return cells as data.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "backend/backend.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/feedback.h"
#include "backend/opengl/gl.h"
#include "backend/opengl/shader.h"

namespace vorpipe::opengl {

class Cells {
 public:
  Cells() : feedback_(GL_POINTS) {}

  /// Clips the entries or sites that were sent, `count` of them, and replaces out. Lists of lines are clipped
  /// with the capacity EDGES_MOST. Requires a complete framebuffer and a view to be bound, and leaves both
  /// unchanged. Errors (device): out of memory; the device failed; the driver refuses the shaders.
  Result<void> run(Entries entries, Capacity capacity, std::size_t count, CellNeighbors& out);

 private:
  std::array<Program, programs> made_;
  Feedback feedback_;
};

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
