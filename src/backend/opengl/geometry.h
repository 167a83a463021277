/// The geometry pipeline: entries in, triangle strips and statuses out.
#pragma once

#include <span>

#include "backend/backend.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/feedback.h"
#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// Room for edges in each pipeline.
int edgesOf(Room room);

/// Components that one vertex of a strip writes: position, mark, status.
inline constexpr int components_per_vertex = 8;

class Geometry {
 public:
  /// Compiles both pipelines in the current context. Error (device): the driver's log.
  static Result<Geometry> create();

  /// Clips and draws the entries into what is bound. status has one element per entry; one that the
  /// device does not answer becomes `missing`.
  Result<void> draw(const CellBatch<float>& batch, std::span<const DrawMark> marks, Room room,
                    std::span<CellStatus> status);

 private:
  Geometry(GLuint fast, GLuint most);
  void describeVertices() const;

  GLuint fast_, most_;
  GLuint vertices_ = 0;
  Buffer entries_, marks_;
  TexelBuffer lines_;
  Feedback feedback_;
};

}  // namespace vorpipe::opengl
