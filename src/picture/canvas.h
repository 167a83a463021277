/// The context of a drawing.
#pragma once

#include "backend/backend.h"

namespace vorpipe::core {

/// All of it outlives the drawing.
struct Canvas {
  Backend& backend;
  const SiteSet& sites;
  std::span<const std::uint8_t> palette_index;  ///< by index in the set
  int threads;
};

}  // namespace vorpipe::core
