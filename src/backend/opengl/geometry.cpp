#include "backend/opengl/geometry.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "backend/opengl/shader.h"
#include "layout.glsl"
#include "shaders.h"

namespace vorpipe::opengl {
namespace {

using Entry = CellBatch<float>::Entry;

Result<GLuint> linkPipeline(std::string_view geometry) {
  static constexpr std::array<const char*, 1> captured = {"cell_status"};
  return linkProgram({shaders::cell_vert_410(), geometry, shaders::cell_frag_410(), captured});
}

}  // namespace

int edgesOf(Room room) { return room == Room::fast ? EDGES_FAST : EDGES_MOST; }

Result<Geometry> Geometry::create() {
  const auto fast = linkPipeline(shaders::cell_geom_fast_410());
  if (!fast) return tl::unexpected(fast.error());
  const auto most = linkPipeline(shaders::cell_geom_most_410());
  if (!most) return tl::unexpected(most.error());
  Geometry geometry(*fast, *most);
  if (auto made = takeErrors("making the pipelines"); !made) return tl::unexpected(made.error());
  return geometry;
}

Geometry::Geometry(GLuint fast, GLuint most)
    : fast_(fast),
      most_(most),
      entries_(GL_ARRAY_BUFFER, GL_STREAM_DRAW),
      marks_(GL_ARRAY_BUFFER, GL_STREAM_DRAW),
      lines_(GL_RGBA32F, lines_unit) {
  glGenVertexArrays(1, &vertices_);
  describeVertices();
}

// The inputs of cell.vert, as entries and marks lie in memory.
void Geometry::describeVertices() const {
  static_assert(offsetof(Entry, north) == offsetof(Entry, west) + 3 * sizeof(float));
  static_assert(offsetof(Entry, shift) == offsetof(Entry, reach) + sizeof(float));
  static_assert(offsetof(Entry, count) == offsetof(Entry, first) + sizeof(std::uint32_t));
  static_assert(offsetof(DrawMark, shade) == offsetof(DrawMark, id) + sizeof(std::uint32_t));
  glBindVertexArray(vertices_);
  for (GLuint location = 0; location < 5; ++location) glEnableVertexAttribArray(location);
  entries_.bind();
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Entry), bufferOffset(offsetof(Entry, west)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Entry), bufferOffset(offsetof(Entry, reach)));
  glVertexAttribIPointer(2, 2, GL_UNSIGNED_INT, sizeof(Entry), bufferOffset(offsetof(Entry, first)));
  marks_.bind();
  glVertexAttribPointer(3, 2, GL_FLOAT, GL_FALSE, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, x)));
  glVertexAttribIPointer(4, 2, GL_UNSIGNED_INT, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, id)));
}

Result<void> Geometry::draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Room room,
                            std::span<CellStatus> status) {
  const std::size_t count = batch.entries.size();
  assert(marks.size() == count && status.size() == count);
  std::ranges::fill(status, CellStatus::missing);
  entries_.write(std::as_bytes(std::span(batch.entries)));
  marks_.write(std::as_bytes(marks));
  lines_.write(std::as_bytes(std::span(batch.lines)));
  if (auto sent = takeErrors("sending a batch to the device"); !sent) return sent;
  glUseProgram(room == Room::fast ? fast_ : most_);
  glBindVertexArray(vertices_);
  const std::size_t at_once = Feedback::entriesAtOnce(edgesOf(room));
  for (std::size_t first = 0; first < count; first += at_once) {
    feedback_.begin();
    glDrawArrays(GL_POINTS, static_cast<GLint>(first),
                 static_cast<GLsizei>(std::min(at_once, count - first)));
    if (auto answered = feedback_.end(status); !answered) return answered;
  }
  glFinish();
  return takeErrors("drawing a batch");
}

}  // namespace vorpipe::opengl
