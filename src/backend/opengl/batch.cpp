#include "backend/opengl/batch.h"

#include <fmt/core.h>

#include <cstddef>

#include "backend/opengl/bindings.h"

namespace vorpipe::opengl {
namespace {

using Entry = CellBatch<float>::Entry;
static_assert(offsetof(Entry, north) == offsetof(Entry, west) + 3 * sizeof(float));
static_assert(offsetof(Entry, origin_offset) == offsetof(Entry, reach) + sizeof(float));
static_assert(offsetof(Entry, count) == offsetof(Entry, first) + sizeof(std::uint32_t));
static_assert(offsetof(DrawMark, y) == offsetof(DrawMark, x) + sizeof(float));
static_assert(offsetof(DrawMark, palette_index) == offsetof(DrawMark, id) + sizeof(std::uint32_t));
static_assert(sizeof(HalfPlane<float>) == 4 * sizeof(float));

constexpr GLuint attributes = 5;

}  // namespace

// The inputs of cell.vert by location, as entries and marks lie in memory.
Batch::Batch()
    : entries_(GL_ARRAY_BUFFER, GL_STREAM_DRAW),
      marks_(GL_ARRAY_BUFFER, GL_STREAM_DRAW),
      lines_(GL_RGBA32F, lines_unit) {
  glGenVertexArrays(1, &vertices_);
  glBindVertexArray(vertices_);
  for (GLuint location = 0; location < attributes; ++location) glEnableVertexAttribArray(location);
  entries_.bind();
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Entry), bufferOffset(offsetof(Entry, west)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Entry), bufferOffset(offsetof(Entry, reach)));
  glVertexAttribIPointer(2, 2, GL_UNSIGNED_INT, sizeof(Entry), bufferOffset(offsetof(Entry, first)));
  marks_.bind();
  glVertexAttribPointer(3, 2, GL_FLOAT, GL_FALSE, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, x)));
  glVertexAttribIPointer(4, 2, GL_UNSIGNED_INT, sizeof(DrawMark), bufferOffset(offsetof(DrawMark, id)));
}

Result<void> Batch::send(const CellBatch<float>& batch, std::span<const DrawMark> marks) {
  glBindVertexArray(vertices_);
  entries_.write(std::as_bytes(std::span(batch.entries)));
  // Shaders fetch marks even if none are sent.
  marks_.reserve(batch.entries.size() * sizeof(DrawMark));
  marks_.write(std::as_bytes(marks));
  lines_.write(std::as_bytes(std::span(batch.lines)));
  return takeErrors(fmt::format("sending {} entries with {} lines to the device", batch.entries.size(),
                                batch.lines.size()));
}

}  // namespace vorpipe::opengl
