/// Pictures as the judge has them: the site nearest to each pixel's center.
#pragma once

#include <cstdint>
#include <span>

#include "backend/backend.h"
#include "backend/cpu/pixels/nearest_site.h"

namespace vorpipe::cpu {

/// Writes the index in the set of the nearest site for every pixel center of the view; row 0 is
/// the bottom.
void nearestSites(const NearestSite& nearest, const View& view, int threads, std::span<std::uint32_t> out);

/// The same for some of the pixels, numbered row by row.
void nearestSites(const NearestSite& nearest, const View& view, std::span<const std::uint32_t> pixels,
                  int threads, std::span<std::uint32_t> out);

}  // namespace vorpipe::cpu
