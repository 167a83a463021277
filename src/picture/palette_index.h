/// Assigns one of a palette's 256 colors to each site.
#pragma once

#include "vorpipe.h"

namespace vorpipe::core {

struct PaletteIndices {
  std::vector<std::uint8_t> index;  ///< by site, in input order; 0 for sites that have no cell
  std::optional<ColorKey> key;      ///< not set by site
};

/// By site: 256 i / (n + 1), as in the thesis (Listing A.2), i the input index of n. By area, neighbors or
/// weight: from ColorPlaces of the values of sites that have a cell. `cells` are the measures of the same
/// sites. By site they are not read; by weight only their statuses, if there are any. Errors (input): color
/// by weight of sites without weights; a scale, a range or a legend by site; those of ColorPlaces::of.
Result<PaletteIndices> paletteIndices(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                      int threads);

}  // namespace vorpipe::core
