/// Photographs that give cells their colors.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vorpipe/cells.h"
#include "vorpipe/result.h"
#include "vorpipe/sites.h"

namespace vorpipe {

/// Pixels of sRGB, laid out as Image.
struct Photograph {
  int width = 0, height = 0;
  std::vector<std::uint32_t> rgba{};
  std::optional<Box> box{};  ///< where the pixels lie; none: they cover the domain
};

/// Returns the color of each site, by input order, for RenderOptions::site_colors: the mean, in linear light,
/// of the pixels whose centers lie in its cell. A cell without one has the pixel at its site; where there is
/// no photograph, it is white, as are transparent pixels. `cells` name the domain, its outline and its
/// period. The same input gives the same colors, whatever the threads. Errors: those of Locator::make; no
/// pixels (input).
Result<std::vector<std::uint32_t>> photographColors(const Sites& sites, const Photograph& photograph,
                                                    const CellsOptions& cells, int threads = 0);

}  // namespace vorpipe
