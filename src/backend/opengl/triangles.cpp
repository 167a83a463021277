#include "backend/opengl/triangles.h"

#include <cstddef>

#include "base/try.h"
#include "shaders.h"

namespace vorpipe::opengl {

// The inputs of polygon.vert by location, as corners lie in memory.
Triangles::Triangles()
    : corners_(GL_ARRAY_BUFFER, GL_STREAM_DRAW), corner_of_(GL_ELEMENT_ARRAY_BUFFER, GL_STREAM_DRAW) {
  glGenVertexArrays(1, &vertices_);
  glBindVertexArray(vertices_);
  for (const GLuint location : {0U, 1U}) glEnableVertexAttribArray(location);
  corners_.bind();
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, x)));
  glVertexAttribIPointer(1, 2, GL_UNSIGNED_INT, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, id)));
}

Result<void> Triangles::draw(std::span<const DrawMark> corners, std::span<const std::uint32_t> corner_of) {
  VORPIPE_TRY(program_.use({shaders::polygon_vert_410(), {}, shaders::cell_frag_410(), {}}));
  glBindVertexArray(vertices_);
  corners_.write(std::as_bytes(corners));
  corner_of_.write(std::as_bytes(corner_of));
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(corner_of.size()), GL_UNSIGNED_INT, bufferOffset(0));
  glFinish();
  return takeErrors("drawing triangles");
}

}  // namespace vorpipe::opengl
