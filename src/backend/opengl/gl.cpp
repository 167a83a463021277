#include "backend/opengl/gl.h"

#include <fmt/core.h>

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
  GLenum error = glGetError();
  if (error == GL_NO_ERROR) return {};
  // A lost context may report without end; there are as many flags as kinds of error. Calls that follow one
  // without memory are refused, and the flags come in any order.
  constexpr int most_flags = 16;
  for (int i = 0; i < most_flags; ++i) {
    const GLenum other = glGetError();
    if (other == GL_NO_ERROR) break;
    if (other == GL_OUT_OF_MEMORY) error = other;
  }
  return tl::unexpected(Error{ErrorCode::device,
                              fmt::format("opengl: {}: {} (GL error {:#x}); try another device or backend",
                                          doing, nameOf(error), error),
                              error == GL_OUT_OF_MEMORY});
}

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace vorpipe::opengl
