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

/// Color indices of values that are missing, and of names without a color of their own; values in a range
/// have those before.
inline constexpr std::uint8_t missing_color = 255, other_names_color = 254;

/// Returns the palette of a picture; `key` is that of its colors, if there is one. Errors (input): no color
/// map has the name; own colors are fewer than 2 or more than 254, or too few for distinct cells.
Result<Palette> paletteOf(const RenderOptions& options, const std::optional<ColorKey>& key);

struct PaletteIndices {
  std::vector<std::uint8_t> index;  ///< by site, in input order; 0 for sites that have no cell
  std::optional<ColorKey> key;      ///< none if colors are by site or distinct
};

/// By site: 256 i / (n + 1), as in the thesis (Listing A.2), i the input index of n. By area, neighbors,
/// weight or numbers: from ColorPlaces of the values of sites that have a cell. By names: an index for each
/// that cells have, or for the most frequent. Distinct: that of distinctColors(). `cells` are the measures of
/// the same sites. By site they are not read; by weight and values only their statuses, if there are any.
/// Errors (input): color by weight of sites without weights; values that are not as many as the sites, or
/// that no cell has; a scale, a range or a legend of colors that stand for no numbers; those of
/// ColorPlaces::of.
Result<PaletteIndices> paletteIndices(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                      int threads);

}  // namespace vorpipe::core
