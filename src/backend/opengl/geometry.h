/// The pipelines that draw: entries or sites in, triangle strips and statuses out.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "backend/backend.h"
#include "backend/opengl/feedback.h"
#include "backend/opengl/gl.h"
#include "backend/opengl/shader.h"

namespace vorpipe::opengl {

class Geometry {
 public:
  Geometry() : feedback_(GL_TRIANGLES) {}

  /// Clips the entries or sites that were sent and draws them into the bound framebuffer. status has one
  /// element for each; a missing answer of the device becomes `missing`. Errors (device): the device failed;
  /// the driver refuses the shaders.
  Result<void> draw(Entries entries, Capacity capacity, std::span<CellStatus> status);

 private:
  std::array<Program, programs> made_;
  Feedback feedback_;
};

}  // namespace vorpipe::opengl
