/// OpenGL's functions, and its errors as ours.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe::opengl {

/// Takes every error that OpenGL has noted in the current context. Error (device): there was one;
/// `doing` says in the message what was being done.
Result<void> takeErrors(std::string_view doing);

/// One of OpenGL's integers.
GLint integer(GLenum name);

/// What OpenGL takes for the position of something in the bound buffer.
inline const void* bufferOffset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace vorpipe::opengl
