/// Runs shaders only for their feedback.
#pragma once

#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// While it lives, primitives are discarded before rasterization.
class RasterizerDiscard {
 public:
  RasterizerDiscard() { glEnable(GL_RASTERIZER_DISCARD); }
  RasterizerDiscard(const RasterizerDiscard&) = delete;
  RasterizerDiscard& operator=(const RasterizerDiscard&) = delete;
  ~RasterizerDiscard() { glDisable(GL_RASTERIZER_DISCARD); }
};

}  // namespace vorpipe::opengl
