/// Device memory that is written anew for each use.
#pragma once

#include <cstddef>
#include <span>

#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// A buffer object that only grows. Its context owns it; moves hand over the name.
class Buffer {
 public:
  Buffer(GLenum target, GLenum usage);
  Buffer(Buffer&&) = default;

  /// Makes the buffer at least `bytes` large; its contents are lost if it grows. Leaves it bound.
  void reserve(std::size_t bytes);

  /// Replaces its contents. The device must be done with the previous contents. Leaves it bound.
  void write(std::span<const std::byte> bytes);

  void bind() const { glBindBuffer(target_, name_); }
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLenum target_, usage_;
  GLuint name_ = 0;
  std::size_t capacity_ = 0;
};

/// A buffer that shaders read by texelFetch, at a texture unit of its own.
class TexelBuffer {
 public:
  TexelBuffer(GLenum format, GLuint unit);

  /// Replaces its contents.
  void write(std::span<const std::byte> bytes);

 private:
  GLenum format_, unit_;
  Buffer buffer_;
  GLuint texture_ = 0;
};

}  // namespace vorpipe::opengl
