#include "backend/opengl/shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace vorpipe::opengl {
namespace {

using GetParameter = void (*)(GLuint, GLenum, GLint*);
using GetLog = void (*)(GLuint, GLsizei, GLsizei*, GLchar*);

// Shaders and programs are asked alike, by different functions. One line of it, as messages are.
tl::unexpected<Error> failed(std::string_view what, GLuint object, GetParameter parameter, GetLog get_log) {
  GLint length = 0;
  parameter(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  get_log(object, length, nullptr, log.data());
  log.resize(std::min(log.find('\0'), log.size()));
  std::ranges::replace(log, '\n', ' ');
  return tl::unexpected(
      Error{ErrorCode::device, fmt::format("opengl: the driver does not {}: {}; update it, or use "
                                           "another backend",
                                           what, log)});
}

Result<GLuint> compile(GLenum stage, std::string_view name, std::string_view text) {
  const GLuint shader = glCreateShader(stage);
  const GLchar* start = text.data();
  const auto length = static_cast<GLint>(text.size());
  glShaderSource(shader, 1, &start, &length);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  auto error = failed(fmt::format("compile the {} shader", name), shader, glGetShaderiv, glGetShaderInfoLog);
  glDeleteShader(shader);
  return error;
}

void bindByName(GLuint program) {
  if (const GLuint view = glGetUniformBlockIndex(program, "View"); view != GL_INVALID_INDEX) {
    glUniformBlockBinding(program, view, view_binding);
  }
  glUseProgram(program);
  glUniform1i(glGetUniformLocation(program, "lines"), static_cast<GLint>(lines_unit));
  glUniform1i(glGetUniformLocation(program, "palette"), static_cast<GLint>(palette_unit));
}

}  // namespace

Result<GLuint> linkProgram(const ProgramText& text) {
  struct Stage {
    GLenum kind;
    std::string_view name, text;
  };
  const std::array<Stage, 3> stages = {{{GL_VERTEX_SHADER, "vertex", text.vertex},
                                        {GL_GEOMETRY_SHADER, "geometry", text.geometry},
                                        {GL_FRAGMENT_SHADER, "fragment", text.fragment}}};
  const GLuint program = glCreateProgram();
  for (const Stage& stage : stages) {
    if (stage.text.empty()) continue;
    const auto shader = compile(stage.kind, stage.name, stage.text);
    if (!shader) {
      glDeleteProgram(program);
      return tl::unexpected(shader.error());
    }
    glAttachShader(program, *shader);
    glDeleteShader(*shader);
  }
  glTransformFeedbackVaryings(program, static_cast<GLsizei>(text.captured.size()), text.captured.data(),
                              GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    auto error = failed("link the shaders", program, glGetProgramiv, glGetProgramInfoLog);
    glDeleteProgram(program);
    return error;
  }
  bindByName(program);
  return program;
}

}  // namespace vorpipe::opengl
