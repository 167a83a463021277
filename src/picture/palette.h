/// Colors of sites: color maps of 256 entries, and an entry for each site.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "backend/backend.h"
#include "vorpipe.h"

namespace vorpipe::core {

/// Returns the palette of one of colormaps(), opaque. Error (input): no color map has this name.
Result<Palette> paletteByName(std::string_view name);

struct PaletteIndices {
  std::vector<std::uint8_t> index;  ///< by site, in input order; 0 for sites that have no cell
  std::optional<ColorKey> key;      ///< none if colors are by site
};

/// By site: 256 i / (n + 1), as in the thesis (Listing A.2), i the input index of n. By area, neighbors or
/// weight: from ColorPlaces of the values of sites that have a cell. `cells` are the measures of the same
/// sites. By site they are not read; by weight only their statuses, if there are any. Errors (input): color
/// by weight of sites without weights; a scale, a range or a legend by site; those of ColorPlaces::of.
Result<PaletteIndices> paletteIndices(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                      int threads);

}  // namespace vorpipe::core
