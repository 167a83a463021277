#include "backend/opengl/gl.h"

#include <fmt/format.h>

namespace vorpipe::opengl {
namespace {

std::string_view nameOf(GLenum error) {
  switch (error) {
    case GL_OUT_OF_MEMORY:
      return "the device is out of memory";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "the driver cannot draw into this framebuffer";
    default:
      return "the driver refused a call";
  }
}

}  // namespace

Result<void> takeErrors(std::string_view doing) {
  const GLenum first = glGetError();
  if (first == GL_NO_ERROR) return {};
  // A lost context may report without end; there are as many flags as kinds of error.
  constexpr int most_flags = 16;
  for (int i = 0; i < most_flags && glGetError() != GL_NO_ERROR; ++i) {
  }
  return tl::unexpected(
      Error{ErrorCode::device, fmt::format("opengl: {}: {} (GL error {:#x}); try another device or backend",
                                           doing, nameOf(first), first)});
}

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace vorpipe::opengl
