/// The picture: a color and an id per pixel, what it shows and how that is drawn.
#pragma once

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/gl.h"
#include "backend/opengl/shader.h"

namespace vorpipe::opengl {

/// The inputs of cell.vert and the lines that the geometry shaders read.
class Batch {
 public:
  Batch();

  /// Replaces the batch on the device and makes it the input of the next draw call; points are entries. marks
  /// may be empty where the program does not use them. Error (device): out of memory.
  Result<void> send(const CellBatch<float>& batch, std::span<const DrawMark> marks);

 private:
  GLuint vertices_ = 0;
  Buffer entries_, marks_;
  TexelBuffer lines_;
};

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
