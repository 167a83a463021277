/// The picture: a color and an id per pixel, what it shows and how that is drawn.
#pragma once

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

class Picture {
 public:
  /// Creates a picture of one pixel in the current context.
  static Result<Picture> create(int subpixel_bits);

  /// Clears it, at the view's size, and passes the view to the shaders.
  Result<void> begin(const View& view);

  /// Passes the view to the shaders relative to sites of that domain, now and for later views.
  void setDomain(const Box& domain);

  /// Makes it the target of the next draw call, with the view passed to begin().
  void bind() const;

  /// Reads it back, bottom row first. Both spans hold width * height.
  Result<void> read(std::span<std::uint32_t> rgba, std::span<std::uint32_t> ids) const;

 private:
  explicit Picture(int subpixel_bits);
  void sendView();
  Result<void> resize(int width, int height);

  GLuint framebuffer_ = 0, color_ = 0, id_ = 0;
  int width_ = 0, height_ = 0;
  int subpixel_bits_;
  View shown_{{0, 0, 1, 1}, 1, 1, {}};
  Box domain_{0, 0, 1, 1};
  Buffer view_;
  TexelBuffer palette_;
};

}  // namespace vorpipe::opengl
