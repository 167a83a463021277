/// Runs of shaders that draw nothing.
#pragma once

#include "backend/opengl/device/gl.h"

namespace vorpipe::opengl {

/// While it lives, nothing is drawn.
class Discarding {
 public:
  Discarding() { glEnable(GL_RASTERIZER_DISCARD); }
  Discarding(const Discarding&) = delete;
  Discarding& operator=(const Discarding&) = delete;
  ~Discarding() { glDisable(GL_RASTERIZER_DISCARD); }
};

}  // namespace vorpipe::opengl
