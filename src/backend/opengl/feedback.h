/// What the geometry shader says about each entry, by transform feedback.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "backend/backend.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// Catches the outputs of triangles drawn between begin() and end(): one record per vertex, the same
/// in all vertices of a triangle.
class Feedback {
 public:
  /// cell_status of cell.geom.
  struct Record {
    GLuint entry, status;
  };

  Feedback();

  /// How many entries may be drawn between begin() and end(), so that nothing is lost even if each
  /// of them has that many edges.
  static std::size_t entriesAtOnce(int edges);

  void begin() const;

  /// Waits for the device and writes what it said into status, by entry; other elements stay.
  /// Error (device): some of it was lost, or nonsense.
  Result<void> end(std::span<CellStatus> status) const;

 private:
  Buffer buffer_;
  std::array<GLuint, 2> queries_{};
};

}  // namespace vorpipe::opengl
