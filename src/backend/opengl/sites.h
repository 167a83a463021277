/// The sites of an upload on the device, their weights, their grid, and those of them whose cells are wanted.
#pragma once

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/opengl/bindings.h"
#include "backend/opengl/buffer.h"
#include "backend/opengl/gl.h"

namespace vorpipe::opengl {

class Sites {
 public:
  Sites();

  /// Replaces the data on the device; palette_index may be empty if nothing will be drawn. Error (device):
  /// out of memory.
  Result<void> upload(const SiteSet& sites, std::span<const std::uint8_t> palette_index);

  /// Makes the sites `which` the input of the next draw call, one point each. Error (device): out of memory.
  Result<void> send(std::span<const std::uint32_t> which);

  /// Returns their kind for a pipeline.
  [[nodiscard]] Entries entries() const { return weighted_ ? Entries::weighted_sites : Entries::sites; }

 private:
  bool weighted_ = false;
  GLuint vertices_ = 0;
  Buffer which_, grid_;
  TexelBuffer sites_, bins_, marks_, weights_, heaviest_;
};

}  // namespace vorpipe::opengl
