#include "backend/opengl/geometry.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "backend/cell_answers.h"
#include "base/try.h"
#include "layout.glsl"
#include "shaders.h"

namespace vorpipe::opengl {
namespace {

// One vertex's cell_status in cell.geom. All vertices of a triangle say the same.
struct Record {
  GLuint entry, status;
};

constexpr std::size_t triangle_bytes = 3 * sizeof(Record);

ProgramText textOf(Entries entries, bool small) {
  static constexpr std::array<const char*, 1> captured = {"cell_status"};
  if (entries == Entries::lists) {
    const auto geometry = small ? shaders::cell_list_fast_410() : shaders::cell_list_roomy_410();
    return {shaders::cell_vert_410(), geometry, shaders::cell_frag_410(), captured};
  }
  assert(entries == Entries::sites);
  const auto geometry = small ? shaders::cell_grid_fast_410() : shaders::cell_grid_roomy_410();
  return {shaders::site_vert_410(), geometry, shaders::cell_frag_410(), captured};
}

bool readStatuses(std::span<const std::byte> triangles, std::span<CellStatus> status) {
  bool sane = true;
  for (std::size_t at = 0; at < triangles.size(); at += triangle_bytes) {
    Record record;
    std::memcpy(&record, &triangles[at], sizeof(record));
    const bool known = record.entry < status.size();
    if (known) status[record.entry] = statusIn(record.status);
    sane = sane && known;
  }
  return sane;
}

}  // namespace

Result<void> Geometry::draw(Entries entries, Capacity capacity, std::span<CellStatus> status) {
  std::ranges::fill(status, CellStatus::missing);
  const bool small = capacity == Capacity::small;
  VORPIPE_TRY(made_[programOf(entries, capacity)].use(textOf(entries, small)));
  const std::size_t count = status.size();
  const std::size_t triangles = small ? EDGES_FAST - 2 : EDGES_MOST - 2;
  const std::size_t at_once = Feedback::entriesAtOnce(triangles * triangle_bytes);
  for (std::size_t first = 0; first < count; first += at_once) {
    feedback_.begin();
    glDrawArrays(GL_POINTS, static_cast<GLint>(first),
                 static_cast<GLsizei>(std::min(at_once, count - first)));
    const auto read = [status](std::span<const std::byte> said) { return readStatuses(said, status); };
    VORPIPE_TRY(feedback_.end(triangle_bytes, read));
  }
  glFinish();
  return takeErrors("drawing cells");
}

}  // namespace vorpipe::opengl
