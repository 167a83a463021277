/// The pipeline that hands cells back as data.
#pragma once

#include "backend/backend.h"
#include "backend/opengl/batch.h"
#include "backend/opengl/feedback.h"
#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

class Cells {
 public:
  /// Compiles the pipeline in the current context. Error (device): the driver's log.
  static Result<Cells> create();

  /// Clips the entries, in float, and replaces out. Takes a complete framebuffer and a view that are bound,
  /// and leaves both alone. Errors (device): out of memory; the device failed.
  Result<void> run(const CellBatch<double>& batch, Batch& on_device, CellPolygons& out);

 private:
  explicit Cells(GLuint program);

  GLuint program_;
  Feedback feedback_;
};

}  // namespace vorpipe::opengl
