#include "backend/opengl/feedback.h"

namespace vorpipe::opengl {
namespace {

constexpr std::size_t capacity_bytes = std::size_t{64} * 1024 * 1024;
constexpr std::size_t triangle_bytes = 3 * sizeof(Feedback::Record);

GLuint resultOf(GLuint query) {
  GLuint result = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &result);
  return result;
}

tl::unexpected<Error> broken(const char* what) {
  return tl::unexpected(Error{ErrorCode::device, std::string("opengl: transform feedback ") + what +
                                                     "; try another device or backend"});
}

}  // namespace

Feedback::Feedback() : buffer_(GL_TRANSFORM_FEEDBACK_BUFFER, GL_STREAM_READ) {
  buffer_.reserve(capacity_bytes);
  glGenQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

std::size_t Feedback::entriesAtOnce(int edges) {
  return capacity_bytes / (triangle_bytes * static_cast<std::size_t>(edges - 2));
}

void Feedback::begin() const {
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer_.name());
  glBeginQuery(GL_PRIMITIVES_GENERATED, queries_[0]);
  glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, queries_[1]);
  glBeginTransformFeedback(GL_TRIANGLES);
}

Result<void> Feedback::end(std::span<CellStatus> status) const {
  glEndTransformFeedback();
  glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
  glEndQuery(GL_PRIMITIVES_GENERATED);
  const std::size_t triangles = resultOf(queries_[1]);
  if (resultOf(queries_[0]) != triangles) return broken("lost statuses");
  if (triangles == 0) return {};
  buffer_.bind();
  const auto* records = static_cast<const Record*>(glMapBufferRange(
      GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLsizeiptr>(triangles * triangle_bytes), GL_MAP_READ_BIT));
  if (records == nullptr) return broken("cannot be read");
  bool sane = true;
  for (std::size_t t = 0; t < triangles; ++t) {
    const Record record = records[3 * t];
    const bool known = record.entry < status.size() && record.status <= static_cast<GLuint>(CellStatus::open);
    if (known) status[record.entry] = static_cast<CellStatus>(record.status);
    sane = sane && known;
  }
  const bool kept = glUnmapBuffer(GL_TRANSFORM_FEEDBACK_BUFFER) == GL_TRUE;
  if (!kept || !sane) return broken("gave statuses that make no sense");
  return {};
}

}  // namespace vorpipe::opengl
