#include "backend/opengl/shader.h"
#include "base/try.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>

namespace vorpipe::opengl {
namespace {

using GetParameter = void (*)(GLuint, GLenum, GLint*);
using GetLog = void (*)(GLuint, GLsizei, GLsizei*, GLchar*);

// Returns the log as one line, like all messages. Shaders and programs are queried alike, by different
// functions.
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

// Binds the blocks and samplers that the program has.
void bindByName(GLuint program) {
  struct Named {
    const char* name;
    GLuint index;
  };
  for (const auto& [name, index] : {Named{"View", view_binding}, Named{"SiteGrid", grid_binding}}) {
    const GLuint block = glGetUniformBlockIndex(program, name);
    if (block != GL_INVALID_INDEX) glUniformBlockBinding(program, block, index);
  }
  glUseProgram(program);
  for (const auto& [name, index] :
       {Named{"lines", lines_unit}, Named{"palette", palette_unit}, Named{"sites", sites_unit},
        Named{"bin_starts", bins_unit}, Named{"marks", marks_unit}, Named{"weights", weights_unit},
        Named{"heaviest", heaviest_unit}}) {
    glUniform1i(glGetUniformLocation(program, name), static_cast<GLint>(index));
  }
}

Result<GLuint> link(const ProgramText& text) {
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

}  // namespace

std::size_t programOf(Entries entries, Capacity capacity) {
  return 2 * static_cast<std::size_t>(entries) + (capacity == Capacity::small ? 0U : 1U);
}

Result<void> Program::use(const ProgramText& text) {
  if (name_ == 0) {
    VORPIPE_LET(linked, link(text));
    name_ = linked;
  }
  glUseProgram(name_);
  return {};
}

}  // namespace vorpipe::opengl
