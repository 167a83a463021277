/// Programs from GLSL 4.10 text.
#pragma once

#include <span>
#include <string_view>

#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// Texture units and the uniform binding that every program uses.
inline constexpr GLuint lines_unit = 0;
inline constexpr GLuint palette_unit = 1;
inline constexpr GLuint view_binding = 0;

struct ProgramText {
  std::string_view vertex, geometry, fragment;  ///< fragment may be empty: nothing is drawn
  std::span<const char* const> captured;        ///< outputs for transform feedback, interleaved
};

/// Compiles and links; binds `View`, `lines` and `palette` where it has them. Leaves it in use.
/// Error (device): the driver's log.
Result<GLuint> linkProgram(const ProgramText& text);

}  // namespace vorpipe::opengl
