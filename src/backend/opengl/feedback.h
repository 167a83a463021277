/// The outputs of geometry shaders, read back by transform feedback.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include "backend/opengl/buffer.h"
#include "backend/opengl/gl.h"
#include "vorpipe.h"

namespace vorpipe::opengl {

/// While it lives, primitives are discarded before rasterization.
class RasterizerDiscard {
 public:
  RasterizerDiscard() { glEnable(GL_RASTERIZER_DISCARD); }
  RasterizerDiscard(const RasterizerDiscard&) = delete;
  RasterizerDiscard& operator=(const RasterizerDiscard&) = delete;
  ~RasterizerDiscard() { glDisable(GL_RASTERIZER_DISCARD); }
};

/// Captures outputs of everything drawn between begin() and end(): those that the program was linked to
/// capture.
class Feedback {
 public:
  /// Captures points, lines or triangles, as `primitive` says.
  explicit Feedback(GLenum primitive);

  /// The most entries that may be drawn between begin() and end(): the buffer holds `entry_bytes` of output
  /// for each of them.
  [[nodiscard]] static std::size_t entriesAtOnce(std::size_t entry_bytes);

  void begin();

  /// Waits for the device and passes all captured bytes to `read`: `primitive_bytes` for each primitive, in
  /// the order drawn. `read` returns whether they are valid. Error (device): they are not, or some were lost.
  Result<void> end(std::size_t primitive_bytes,
                   const std::function<bool(std::span<const std::byte>)>& read) const;

 private:
  GLenum primitive_;
  Buffer buffer_;
  std::array<GLuint, 2> queries_{};
};

}  // namespace vorpipe::opengl
