/// What is clipped to an outline.
#pragma once

#include <cstdint>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::core {

/// The sites of a diagram and its domain, and where things are in it.
struct ClippedRun {
  const Sites& sites;
  const Box& domain;
  const std::vector<std::uint32_t>& order;  ///< the sites that may have cells, neighbors near each other
  int exponent;                             ///< what is computed is in units times 2^exponent
  int threads;
};

}  // namespace vorpipe::core
