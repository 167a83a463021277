/// The pipelines that draw: entries in, triangle strips and statuses out.
#pragma once

#include <cstddef>
#include <span>

#include "backend/backend.h"
#include "backend/opengl/feedback.h"
#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// Room for edges in each pipeline.
int edgesOf(Room room);

/// Components that one vertex of a strip writes: position, mark, status.
inline constexpr int components_per_vertex = 8;

class Geometry {
 public:
  /// Compiles the pipelines in the current context. Error (device): the driver's log.
  static Result<Geometry> create();

  /// Clips the entries of the batch that was sent and draws them into what is bound. status has one element
  /// per entry; one that the device does not answer becomes `missing`.
  Result<void> draw(Room room, std::span<CellStatus> status);

 private:
  Geometry(GLuint fast, GLuint most);

  GLuint fast_, most_;
  Feedback feedback_;
};

}  // namespace vorpipe::opengl
