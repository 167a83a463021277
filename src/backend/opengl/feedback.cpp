#include "backend/opengl/feedback.h"

#include <fmt/core.h>

#include <string_view>

#include "base/try.h"

namespace vorpipe::opengl {
namespace {

/// Bytes that the shaders write in one draw, at most.
constexpr std::size_t feedback_bytes = std::size_t{32} * 1024 * 1024;

GLuint resultOf(GLuint query) {
  GLuint result = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &result);
  return result;
}

// The error that OpenGL reports, or if it reports none, that transform feedback `what`.
tl::unexpected<Error> broken(std::string_view what) {
  VORPIPE_TRY(takeErrors("reading what the shaders say"));
  return tl::unexpected(Error{
      ErrorCode::device, fmt::format("opengl: transform feedback {}; try another device or backend", what)});
}

}  // namespace

Feedback::Feedback(GLenum primitive)
    : primitive_(primitive), buffer_(GL_TRANSFORM_FEEDBACK_BUFFER, GL_STREAM_READ) {
  glGenQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

std::size_t Feedback::entriesAtOnce(std::size_t entry_bytes) { return feedback_bytes / entry_bytes; }

void Feedback::begin() {
  buffer_.reserve(feedback_bytes);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer_.name());
  glBeginQuery(GL_PRIMITIVES_GENERATED, queries_[0]);
  glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, queries_[1]);
  glBeginTransformFeedback(primitive_);
}

Result<void> Feedback::end(std::size_t primitive_bytes,
                           const std::function<bool(std::span<const std::byte>)>& read) const {
  glEndTransformFeedback();
  glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
  glEndQuery(GL_PRIMITIVES_GENERATED);
  const std::size_t written = resultOf(queries_[1]);
  if (resultOf(queries_[0]) != written) return broken("lost a part of the answer");
  if (written == 0) return {};
  const std::size_t bytes = written * primitive_bytes;
  const auto* start = static_cast<const std::byte*>(
      glMapBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT));
  if (start == nullptr) return broken("cannot be read");
  bool sane = false;
  try {
    sane = read(std::span(start, bytes));
  } catch (...) {
    glUnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER);
    throw;
  }
  const bool kept = glUnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER) == GL_TRUE;
  if (!kept || !sane) return broken("gave an answer that makes no sense");
  return {};
}

}  // namespace vorpipe::opengl
