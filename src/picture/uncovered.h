/// Pixels that no cell of a device covered.
#pragma once

#include <cstdint>
#include <span>

#include "cells/judge.h"

namespace vorpipe::core {

/// The data that fills pixels without a site; all of it outlives this.
struct NearestSites {
  Judge& judge;
  const SiteSet& sites;
  std::span<const std::uint8_t> palette_index;  ///< by index in the set
  std::uint64_t ids;                            ///< ids of sites are less than this
  int threads;
};

/// Fills every pixel of a view that a device left without a site or with an invalid id, for whatever reason.
/// The pixel gets its nearest site and that site's color; if no site has a cell, no site and color 0. Row 0
/// is the bottom. Returns the number of such pixels; if it is 0, nothing is written.
std::uint64_t coverRest(const NearestSites& nearest, const View& view, std::span<std::uint32_t> rgba,
                        std::span<std::uint32_t> ids);

}  // namespace vorpipe::core
