#include "backend/opengl/arithmetic.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "backend/opengl/discarding.h"
#include "base/try.h"
#include "shaders.h"

namespace vorpipe::opengl {
namespace {

static_assert(sizeof(Operands) == 4 * sizeof(float) && sizeof(Computed) == 8 * sizeof(float));

constexpr std::array<const char*, 2> captured = {"computed_first", "computed_second"};

}  // namespace

Calculator::Calculator() : operands_(GL_ARRAY_BUFFER, GL_STREAM_DRAW), feedback_(GL_POINTS) {
  glGenVertexArrays(1, &attributes_);
  glBindVertexArray(attributes_);
  glEnableVertexAttribArray(0);
  operands_.bind();
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Operands), bufferOffset(0));
}

Result<void> Calculator::run(std::span<const Operands> operands, std::span<Computed> out) {
  assert(operands.size() == out.size());
  VORPIPE_TRY(program_.use({shaders::arithmetic_vert_410(), {}, {}, captured}));
  glBindVertexArray(attributes_);
  operands_.write(std::as_bytes(operands));
  const RasterizerDiscard discard;
  const std::size_t at_once = Feedback::entriesAtOnce(sizeof(Computed));
  for (std::size_t first = 0; first < operands.size(); first += at_once) {
    const std::span<Computed> part = out.subspan(first, std::min(at_once, out.size() - first));
    feedback_.begin();
    glDrawArrays(GL_POINTS, static_cast<GLint>(first), static_cast<GLsizei>(part.size()));
    const auto read = [part](std::span<const std::byte> said) {
      if (said.size() != part.size_bytes()) return false;
      std::memcpy(part.data(), said.data(), said.size());
      return true;
    };
    VORPIPE_TRY(feedback_.end(sizeof(Computed), read));
  }
  return takeErrors("computing");
}

}  // namespace vorpipe::opengl
