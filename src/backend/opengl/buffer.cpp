#include "backend/opengl/buffer.h"

namespace vorpipe::opengl {
namespace {

// OpenGL does not define a texture on an empty buffer, so there is always room for something.
constexpr std::size_t granularity = std::size_t{64} * 1024;

}  // namespace

Buffer::Buffer(GLenum target, GLenum usage) : target_(target), usage_(usage) { glGenBuffers(1, &name_); }

void Buffer::reserve(std::size_t bytes) {
  bind();
  if (capacity_ > 0 && bytes <= capacity_) return;
  const std::size_t capacity = (bytes / granularity + 1) * granularity;
  glBufferData(target_, static_cast<GLsizeiptr>(capacity), nullptr, usage_);
  GLint64 allocated = 0;
  glGetBufferParameteri64v(target_, GL_BUFFER_SIZE, &allocated);
  capacity_ = static_cast<std::size_t>(allocated);
}

void Buffer::write(std::span<const std::byte> bytes) {
  reserve(bytes.size());
  if (!bytes.empty()) glBufferSubData(target_, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

TexelBuffer::TexelBuffer(GLenum format, GLuint unit)
    : format_(format), unit_(GL_TEXTURE0 + unit), buffer_(GL_TEXTURE_BUFFER, GL_STREAM_DRAW) {
  glGenTextures(1, &texture_);
}

void TexelBuffer::write(std::span<const std::byte> bytes) {
  buffer_.write(bytes);
  glActiveTexture(unit_);
  glBindTexture(GL_TEXTURE_BUFFER, texture_);
  glTexBuffer(GL_TEXTURE_BUFFER, format_, buffer_.name());
}

}  // namespace vorpipe::opengl
