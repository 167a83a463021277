/// Pixels that no cell of a device covered.
#pragma once

#include <cstdint>
#include <span>

#include "cells/judge.h"

namespace vorpipe::core {

/// What pixels without a site get theirs from; all of it outlives this.
struct NearestSites {
  Judge& judge;
  const SiteSet& sites;
  std::span<const std::uint8_t> palette_index;  ///< by index in the set
  std::uint64_t ids;                            ///< those of sites are less
  int threads;
};

/// Gives every pixel of a view that a device left without a site, or with an id that no site has, its nearest
/// site and the color of that, whatever the reason; if no site has a cell, none and color 0. Row 0 is the
/// bottom. Returns how many there were: where there are none, this only looks.
std::uint64_t coverRest(const NearestSites& nearest, const View& view, std::span<std::uint32_t> rgba,
                        std::span<std::uint32_t> ids);

}  // namespace vorpipe::core
