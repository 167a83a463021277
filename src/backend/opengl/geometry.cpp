#include "backend/opengl/geometry.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "backend/opengl/shader.h"
#include "layout.glsl"
#include "shaders.h"

namespace vorpipe::opengl {
namespace {

// One vertex's cell_status in cell.geom. All vertices of a triangle say the same.
struct Record {
  GLuint entry, status;
};

constexpr std::size_t triangle_bytes = 3 * sizeof(Record);

Result<GLuint> linkPipeline(std::string_view geometry) {
  static constexpr std::array<const char*, 1> captured = {"cell_status"};
  return linkProgram({shaders::cell_vert_410(), geometry, shaders::cell_frag_410(), captured});
}

bool readStatuses(std::span<const std::byte> triangles, std::span<CellStatus> status) {
  bool sane = true;
  for (std::size_t at = 0; at < triangles.size(); at += triangle_bytes) {
    Record record;
    std::memcpy(&record, &triangles[at], sizeof(record));
    const bool known = record.entry < status.size() && record.status <= static_cast<GLuint>(CellStatus::open);
    if (known) status[record.entry] = static_cast<CellStatus>(record.status);
    sane = sane && known;
  }
  return sane;
}

}  // namespace

int edgesOf(Room room) { return room == Room::fast ? EDGES_FAST : EDGES_MOST; }

Result<Geometry> Geometry::create() {
  const auto fast = linkPipeline(shaders::cell_geom_fast_410());
  if (!fast) return tl::unexpected(fast.error());
  const auto most = linkPipeline(shaders::cell_geom_most_410());
  if (!most) return tl::unexpected(most.error());
  return Geometry(*fast, *most);
}

Geometry::Geometry(GLuint fast, GLuint most)
    : fast_(fast), most_(most), feedback_(GL_TRIANGLES, triangle_bytes) {}

Result<void> Geometry::draw(Room room, std::span<CellStatus> status) {
  std::ranges::fill(status, CellStatus::missing);
  glUseProgram(room == Room::fast ? fast_ : most_);
  const std::size_t count = status.size();
  const std::size_t at_once = feedback_.entriesAtOnce(static_cast<std::size_t>(edgesOf(room)) - 2);
  for (std::size_t first = 0; first < count; first += at_once) {
    feedback_.begin();
    glDrawArrays(GL_POINTS, static_cast<GLint>(first),
                 static_cast<GLsizei>(std::min(at_once, count - first)));
    const auto read = [status](std::span<const std::byte> said) { return readStatuses(said, status); };
    if (auto answered = feedback_.end(read); !answered) return answered;
  }
  glFinish();
  return takeErrors("drawing a batch");
}

}  // namespace vorpipe::opengl
