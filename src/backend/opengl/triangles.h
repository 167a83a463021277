/// Draws the caller's triangles unchanged.
#pragma once

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/gl.h"
#include "backend/opengl/shader.h"

namespace vorpipe::opengl {

class Triangles {
 public:
  Triangles();

  /// Draws them into the bound framebuffer. Errors (device): out of memory; the driver refuses the shaders.
  Result<void> draw(std::span<const DrawMark> corners, std::span<const std::uint32_t> corner_of);

 private:
  GLuint vertices_ = 0;
  Buffer corners_, corner_of_;
  Program program_;
};

}  // namespace vorpipe::opengl
