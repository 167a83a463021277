/// What the geometry shaders say, by transform feedback.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include "backend/opengl/device/gl.h"
#include "backend/opengl/memory/buffer.h"
#include "vorpipe.h"

namespace vorpipe::opengl {

/// Catches the outputs that a program was linked to capture, of what is drawn between begin() and end().
class Feedback {
 public:
  /// For primitives of one kind.
  explicit Feedback(GLenum primitive);

  /// How many entries may be drawn between begin() and end() so that nothing is lost even if each of
  /// them makes that many bytes.
  [[nodiscard]] static std::size_t entriesAtOnce(std::size_t entry_bytes);

  void begin();

  /// Waits for the device and hands all that it said to read, so many bytes for each primitive, in the
  /// order drawn. read returns whether it makes sense. Error (device): it does not, or some of it was lost.
  Result<void> end(std::size_t primitive_bytes,
                   const std::function<bool(std::span<const std::byte>)>& read) const;

 private:
  GLenum primitive_;
  Buffer buffer_;
  std::array<GLuint, 2> queries_{};
};

}  // namespace vorpipe::opengl
