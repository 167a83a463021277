/// A batch of cells on the device.
#pragma once

#include <span>

#include "backend/backend.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

/// The inputs of cell.vert and the lines that the geometry shaders read.
class Batch {
 public:
  Batch();

  /// Replaces the batch on the device and makes it the input of the next draw call; points are entries. marks
  /// may be empty where the program does not use them. Error (device): out of memory.
  Result<void> send(const CellBatch<float>& batch, std::span<const DrawMark> marks);

 private:
  GLuint vertices_ = 0;
  Buffer entries_, marks_;
  TexelBuffer lines_;
};

}  // namespace vorpipe::opengl
