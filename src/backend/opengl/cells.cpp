#include "backend/opengl/cells.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "backend/cell_answers.h"
#include "backend/opengl/feedback.h"
#include "base/try.h"
#include "layout.glsl"
#include "shaders.h"

namespace vorpipe::opengl {
namespace {

// cell_answer and cell_neighbors of edges.geom: one of each for an entry, in the order drawn.
constexpr std::size_t word_bytes = sizeof(GLint);

ProgramText textOf(Entries entries, bool small) {
  static constexpr std::array<const char*, 2> captured = {"cell_answer", "cell_neighbors"};
  if (entries == Entries::lists)
    return {shaders::cell_vert_410(), shaders::edges_list_roomy_410(), {}, captured};
  auto geometry = small ? shaders::edges_grid_fast_410() : shaders::edges_grid_roomy_410();
  if (entries == Entries::weighted_sites) {
    geometry = small ? shaders::edges_grid_fast_weighted_410() : shaders::edges_grid_roomy_weighted_410();
  }
  return {shaders::site_vert_410(), geometry, {}, captured};
}

}  // namespace

Result<void> Cells::run(Entries entries, Capacity capacity, std::size_t count, CellNeighbors& out) {
  out = {};
  out.offsets.push_back(0);
  const bool small = entries != Entries::lists && capacity == Capacity::small;
  const std::size_t room = answerRoom(small ? EDGES_FAST : EDGES_MOST, entries == Entries::weighted_sites);
  const std::size_t row_bytes = room * sizeof(GLint);
  const std::size_t record_bytes = word_bytes + row_bytes;
  VORPIPE_TRY(made_[programOf(entries, capacity)].use(textOf(entries, small)));
  const RasterizerDiscard discard;
  const std::size_t at_once = Feedback::entriesAtOnce(record_bytes);
  Result<void> answered;
  for (std::size_t first = 0; first < count && answered; first += at_once) {
    const std::size_t here = std::min(at_once, count - first);
    feedback_.begin();
    glDrawArrays(GL_POINTS, static_cast<GLint>(first), static_cast<GLsizei>(here));
    answered = feedback_.end(record_bytes, [&](std::span<const std::byte> said) {
      if (said.size() != here * record_bytes) return false;
      append({here, room, said.data(), record_bytes, said.data() + word_bytes, record_bytes}, out);
      return true;
    });
  }
  if (!answered) return answered;
  return takeErrors("clipping cells");
}

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
