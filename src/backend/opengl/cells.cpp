#include "backend/opengl/cells.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "backend/opengl/shader.h"
#include "layout.glsl"
#include "shaders.h"

namespace vorpipe::opengl {
namespace {

// edge_start and edge_of of edges.geom: one per edge, in the order of entries and then of ranks, and
// one of rank -1 for an entry without edges.
struct Record {
  GLfloat x, y;
  GLint entry, status, line, rank;
};

CellBatch<float> toFloat(const CellBatch<double>& batch) {
  const auto f = [](double value) { return static_cast<float>(value); };
  CellBatch<float> converted;
  converted.entries.reserve(batch.entries.size());
  converted.lines.reserve(batch.lines.size());
  for (const auto& e : batch.entries) {
    converted.entries.push_back(
        {e.first, e.count, f(e.west), f(e.south), f(e.east), f(e.north), f(e.reach), f(e.shift)});
  }
  for (const auto& l : batch.lines) converted.lines.push_back({f(l.nx), f(l.ny), f(l.h), f(l.bound)});
  return converted;
}

// Takes over what the device said next. While this goes on, first[e] counts the edges of entry e - 1.
bool append(std::span<const std::byte> records, CellPolygons& out) {
  for (std::size_t at = 0; at < records.size(); at += sizeof(Record)) {
    Record record;
    std::memcpy(&record, &records[at], sizeof(record));
    const auto entry = static_cast<std::size_t>(record.entry);
    if (entry >= out.status.size() || record.status < 0 || record.status > CELL_OPEN) return false;
    out.status[entry] = static_cast<CellStatus>(record.status);
    if (record.rank < 0) continue;
    if (static_cast<GLuint>(record.rank) != out.first[entry + 1]) return false;
    ++out.first[entry + 1];
    out.x.push_back(static_cast<double>(record.x));
    out.y.push_back(static_cast<double>(record.y));
    out.line.push_back(record.line);
  }
  return true;
}

}  // namespace

Result<Cells> Cells::create() {
  static constexpr std::array<const char*, 2> captured = {"edge_start", "edge_of"};
  const auto program = linkProgram({shaders::cell_vert_410(), shaders::edges_geom_most_410(), {}, captured});
  if (!program) return tl::unexpected(program.error());
  return Cells(*program);
}

Cells::Cells(GLuint program) : program_(program), feedback_(GL_POINTS, sizeof(Record)) {}

Result<void> Cells::run(const CellBatch<double>& batch, Batch& on_device, CellPolygons& out) {
  const std::size_t count = batch.entries.size();
  out = {};
  out.status.assign(count, CellStatus::missing);
  out.first.assign(count + 1, 0);
  if (auto sent = on_device.send(toFloat(batch), {}); !sent) return sent;
  glUseProgram(program_);
  glEnable(GL_RASTERIZER_DISCARD);
  const std::size_t at_once = feedback_.entriesAtOnce(EDGES_MOST);
  Result<void> answered;
  for (std::size_t first = 0; first < count && answered; first += at_once) {
    feedback_.begin();
    glDrawArrays(GL_POINTS, static_cast<GLint>(first),
                 static_cast<GLsizei>(std::min(at_once, count - first)));
    answered = feedback_.end([&out](std::span<const std::byte> said) { return append(said, out); });
  }
  glDisable(GL_RASTERIZER_DISCARD);
  if (!answered) return answered;
  for (std::size_t e = 0; e < count; ++e) out.first[e + 1] += out.first[e];
  return takeErrors("clipping a batch");
}

}  // namespace vorpipe::opengl
