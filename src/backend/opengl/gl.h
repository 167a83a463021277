/// OpenGL's functions, and its errors as vorpipe's.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::opengl {

/// Clears all errors recorded in the current context. Error (device): there was one; the message says with
/// `doing` what was being done.
Result<void> takeErrors(std::string_view doing);

/// Returns an integer parameter of OpenGL.
GLint integer(GLenum name);

/// Returns a position in the bound buffer in the form that OpenGL expects.
inline const void* bufferOffset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace vorpipe::opengl
