#include "picture/palette.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "base/try.h"
#include "picture/color_scale.h"
#include "picture/distinct_colors.h"
#include "picture/pixels.h"
#include "vorpipe/shapes.h"

namespace vorpipe::core {
namespace {

// Each map is a few control points, 0xRRGGBB, at equal distances; between them it is linear in sRGB.
constexpr std::array<std::uint32_t, 10> viridis = {0x440154, 0x482878, 0x3E4989, 0x31688E, 0x26828E,
                                                   0x1F9E89, 0x35B779, 0x6ECE58, 0xB5DE2B, 0xFDE725};
constexpr std::array<std::uint32_t, 10> magma = {0x000004, 0x180F3D, 0x440F76, 0x721F81, 0x9E2F7F,
                                                 0xCD4071, 0xF1605D, 0xFD9668, 0xFECA8D, 0xFCFDBF};
constexpr std::array<std::uint32_t, 10> inferno = {0x000004, 0x1B0C41, 0x4A0C6B, 0x781C6D, 0xA52C60,
                                                   0xCF4446, 0xED6925, 0xFB9B06, 0xF7D13D, 0xFCFFA4};
constexpr std::array<std::uint32_t, 10> plasma = {0x0D0887, 0x46039F, 0x7201A8, 0x9C179E, 0xBD3786,
                                                  0xD8576B, 0xED7953, 0xFB9F3A, 0xFDCA26, 0xF0F921};
constexpr std::array<std::uint32_t, 10> cividis = {0x00204D, 0x00336F, 0x39486B, 0x575C6D, 0x707173,
                                                   0x8A8779, 0xA69D75, 0xC4B56C, 0xE4CF5B, 0xFFEA46};
constexpr std::array<std::uint32_t, 15> turbo = {0x30123B, 0x4145AB, 0x4675ED, 0x39A2FC, 0x1BCFD4,
                                                 0x24ECA6, 0x61FC6C, 0xA4FC3B, 0xD1E834, 0xF3C63A,
                                                 0xFE9B2D, 0xF36315, 0xD93806, 0xB11901, 0x7A0402};
constexpr std::array<std::uint32_t, 2> gray = {0x000000, 0xFFFFFF};
constexpr std::array<std::uint32_t, 3> thesis = {0x2040C0, 0xE8E8E0, 0xC02020};

/// Colors that people with any kind of color vision tell apart (Okabe and Ito 2008), without their black. The
/// first four differ in lightness as well, so that they are told apart in a gray print.
constexpr std::array<std::uint32_t, 7> okabe_ito = {0xE69F00, 0x0072B2, 0xF0E442, 0x009E73,
                                                    0x56B4E9, 0xD55E00, 0xCC79A7};
constexpr std::uint32_t gray_of_missing = 0xFFD2D2D2u, gray_of_others = 0xFF8C8C8Cu;

struct Colormap {
  std::string_view name;
  std::span<const std::uint32_t> points;
};

constexpr std::array<Colormap, 8> maps = {{{"viridis", viridis},
                                           {"magma", magma},
                                           {"inferno", inferno},
                                           {"plasma", plasma},
                                           {"cividis", cividis},
                                           {"turbo", turbo},
                                           {"gray", gray},
                                           {"thesis", thesis}}};

/// Entry `index` of 256, in integers so that every compiler gives the same color.
std::uint32_t colorAt(std::span<const std::uint32_t> points, std::size_t index) {
  constexpr std::uint32_t last = std::tuple_size_v<Palette> - 1;
  const auto position = static_cast<std::uint32_t>(index * (points.size() - 1));
  const std::size_t segment = std::min<std::size_t>(position / last, points.size() - 2);
  const std::uint32_t part = position - static_cast<std::uint32_t>(segment) * last;
  std::uint32_t color = 0xFF000000u;
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    const std::uint32_t shift = 16 - 8 * channel;
    const std::uint32_t from = points[segment] >> shift & 0xFF;
    const std::uint32_t to = points[segment + 1] >> shift & 0xFF;
    color |= (from * (last - part) + to * part + last / 2) / last << (8 * channel);
  }
  return color;
}

constexpr std::size_t palette_index_grain = 1 << 12;

/// Returns the number of sites that are neighbors of a cell; with an outline, one may share several edges.
double neighborsOf(const Diagram& cells, std::size_t site) {
  const auto* neighbors = cells.neighbors.data();
  std::vector<std::int64_t> sites(neighbors + cells.cell_offsets[site],
                                  neighbors + cells.cell_offsets[site + 1]);
  std::erase_if(sites, [](std::int64_t neighbor) { return neighbor < 0; });
  std::ranges::sort(sites);
  return static_cast<double>(std::unique(sites.begin(), sites.end()) - sites.begin());
}

std::vector<std::uint8_t> indicesBySite(std::size_t sites) {
  std::vector<std::uint8_t> indices(sites);
  for (std::size_t i = 0; i < sites; ++i) indices[i] = static_cast<std::uint8_t>(256 * i / (sites + 1));
  return indices;
}

/// Refuses options that need values in a range.
Result<void> checkNoScale(const RenderOptions& options, std::string_view colors) {
  const auto refuse = [&](std::string_view what) {
    return tl::unexpected(Error{ErrorCode::input, fmt::format("{}: {}", what, colors)});
  };
  if (options.color_scale != ColorScale::automatic) return refuse("color scale");
  if (options.color_range) return refuse("color range");
  if (options.legend && !colorsHaveKey(options.color)) return refuse("legend");
  return {};
}

Result<void> checkOwnColors(const Sites& sites, const RenderOptions& options) {
  const std::size_t count = options.site_colors.size();
  if (count == 0) return {};
  const auto refuse = [](std::string message) {
    return tl::unexpected(Error{ErrorCode::input, "site colors: " + std::move(message)});
  };
  if (options.color != ColorBy::site) return refuse("are given, and so is another way to color");
  if (count != sites.size()) return refuse(fmt::format("are {} for {} sites", count, sites.size()));
  return {};
}

/// Returns 0xRRGGBB of a color whose R is in the lowest byte, or the reverse.
std::uint32_t turned(std::uint32_t color) {
  return (color & 0xFF) << 16 | (color & 0xFF00) | (color >> 16 & 0xFF);
}

/// Color k of names and distinct cells, if none are given: after the first seven their lighter and darker
/// shades.
std::uint32_t separateColor(std::size_t k) {
  const std::uint32_t color = 0xFF000000u | turned(okabe_ito[k % okabe_ito.size()]);
  if (k < okabe_ito.size()) return color;
  return mixed(k < 2 * okabe_ito.size() ? white : black, 0.5, color);
}

/// The most colors that distinct cells take: those of a plane six, of a periodic domain seven.
constexpr std::size_t most_distinct = 7;

/// Returns how many colors stand for something each.
std::size_t separateColors(const RenderOptions& options, const std::optional<ColorKey>& key) {
  if (options.color == ColorBy::distinct) return most_distinct;
  return key ? key->names.size() : options.values.names.size();
}

/// Returns names by how many cells have them: at most `most`, the most frequent, in their own order.
std::vector<std::uint32_t> namesWithColor(std::span<const std::uint64_t> cells, std::size_t most) {
  std::vector<std::uint32_t> names;
  for (std::uint32_t k = 0; k < cells.size(); ++k) {
    if (cells[k] > 0) names.push_back(k);
  }
  if (names.size() <= most) return names;
  std::ranges::stable_sort(names, std::greater{}, [&](std::uint32_t k) { return cells[k]; });
  names.resize(most);
  std::ranges::sort(names);
  return names;
}

template <class HasCell>
Result<PaletteIndices> indicesByName(const RenderOptions& options, std::size_t sites,
                                     const HasCell& has_cell) {
  VORPIPE_TRY(checkNoScale(options, "colors by names stand for no numbers"));
  const SiteValues& values = options.values;
  std::vector<std::uint64_t> cells(values.names.size());
  ColorKey key{options.color};
  for (std::size_t i = 0; i < sites; ++i) {
    if (!has_cell(i)) continue;
    if (values.name_of[i] == no_site) {
      key.has_missing = true;
    } else {
      ++cells[values.name_of[i]];
    }
  }
  const auto shown = namesWithColor(cells, options.colors.empty() ? most_names : options.colors.size());
  std::vector<std::uint8_t> color_of(values.names.size(), other_names_color);
  for (std::size_t color = 0; color < shown.size(); ++color) {
    color_of[shown[color]] = static_cast<std::uint8_t>(color);
    key.names.push_back(values.names[shown[color]]);
  }
  const auto used = std::ranges::count_if(cells, [](std::uint64_t count) { return count > 0; });
  key.other_names = static_cast<std::uint64_t>(used) - shown.size();
  key.title = values.title;
  PaletteIndices indices{std::vector<std::uint8_t>(sites), std::move(key)};
  for (std::size_t i = 0; i < sites; ++i) {
    if (!has_cell(i)) continue;
    indices.index[i] = values.name_of[i] == no_site ? missing_color : color_of[values.name_of[i]];
  }
  return indices;
}

/// Refuses values that are not one for each site.
Result<void> checkValues(const SiteValues& values, std::size_t sites) {
  const std::size_t count = values.names.empty() ? values.numbers.size() : values.name_of.size();
  if (count == sites) return {};
  return tl::unexpected(Error{
      ErrorCode::input, fmt::format("color by values: {} of them, where there are {} sites", count, sites)});
}

}  // namespace

Result<Palette> paletteByName(std::string_view name) {
  const auto* const map = std::ranges::find(maps, name, &Colormap::name);
  if (map == maps.end()) {
    return tl::unexpected(Error{ErrorCode::input, fmt::format("no color map is called \"{}\"; there are {}",
                                                              name, fmt::join(colormaps(), ", "))});
  }
  Palette palette{};
  for (std::size_t i = 0; i < palette.size(); ++i) palette[i] = colorAt(map->points, i);
  return palette;
}

Result<Palette> paletteOf(const RenderOptions& options, const std::optional<ColorKey>& key) {
  static_assert(most_colors == other_names_color);
  const std::size_t own = options.colors.size();
  if (own == 1 || own > most_colors) {
    return tl::unexpected(
        Error{ErrorCode::input, fmt::format("colors: {} of them, must be 2 to {}", own, most_colors)});
  }
  const bool by_value = options.color == ColorBy::value;
  const bool separate = options.color == ColorBy::distinct || (by_value && !options.values.names.empty());
  VORPIPE_VAR(palette, paletteByName(colormapOf(options)));
  if (own > 0) {
    std::vector<std::uint32_t> points(options.colors.size());
    std::ranges::transform(options.colors, points.begin(), [](Color color) { return turned(color.rgba); });
    for (std::size_t i = 0; i < palette.size(); ++i) palette[i] = colorAt(points, i);
  }
  if (separate) {
    const Palette range = palette;
    const std::size_t count = std::min(separateColors(options, key), most_colors);
    for (std::size_t k = 0; k < count; ++k) {
      palette[k] = own > 0 ? options.colors[k % own].rgba
                   : options.colormap.empty()
                       ? separateColor(k)
                       : range[(range.size() - 1) * k / std::max<std::size_t>(1, count - 1)];
    }
    palette[other_names_color] = gray_of_others;
  }
  if (by_value) palette[missing_color] = gray_of_missing;
  return palette;
}

Result<PaletteIndices> paletteIndices(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                      int threads) {
  VORPIPE_TRY(checkOwnColors(sites, options));
  const ColorBy color = options.color;
  if (!colorsHaveKey(color)) {
    const bool by_site = color == ColorBy::site;
    VORPIPE_TRY(checkNoScale(
        options, by_site ? "colors by site stand for no values" : "distinct colors stand for no values"));
    if (by_site) return PaletteIndices{indicesBySite(sites.size()), {}};
    VORPIPE_VAR(colors,
                distinctColors(cells, options.colors.empty() ? most_distinct : options.colors.size()));
    return PaletteIndices{std::move(colors), {}};
  }
  if (color == ColorBy::weight && sites.weight.empty()) {
    return tl::unexpected(Error{ErrorCode::input, "color by weight: the sites have no weights"});
  }
  const auto hasCell = [&](std::size_t i) { return cells.status.empty() || cells.status[i] == Status::ok; };
  const bool by_value = color == ColorBy::value;
  if (by_value) {
    VORPIPE_TRY(checkValues(options.values, sites.size()));
    if (!options.values.names.empty()) return indicesByName(options, sites.size(), hasCell);
  }
  const auto valueOf = [&](std::size_t i) {
    if (by_value) return options.values.numbers[i];
    if (color == ColorBy::weight) return sites.weight[i];
    return color == ColorBy::area ? cells.area[i] : neighborsOf(cells, i);
  };
  std::vector<double> values;
  values.reserve(sites.size());
  bool has_missing = false;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!hasCell(i)) continue;
    const double value = valueOf(i);
    if (by_value && !std::isfinite(value)) {
      has_missing = true;
    } else {
      values.push_back(value);
    }
  }
  if (by_value && values.empty()) {
    return tl::unexpected(Error{ErrorCode::input, "color by values: no cell has one"});
  }
  VORPIPE_LET(places,
              ColorPlaces::of({color, options.color_scale, options.color_range}, std::move(values), threads));
  PaletteIndices indices{std::vector<std::uint8_t>(sites.size()), places.key()};
  indices.key->title = options.values.title;
  indices.key->has_missing = has_missing;
  parallelFor(sites.size(), palette_index_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      if (!hasCell(i)) continue;
      const double value = valueOf(i);
      if (!by_value) {
        indices.index[i] = places.colorOf(value);
      } else {
        indices.index[i] =
            std::isfinite(value) ? std::min(places.colorOf(value), other_names_color) : missing_color;
      }
    }
  });
  return indices;
}

}  // namespace vorpipe::core

namespace vorpipe {

std::vector<std::string> colormaps() {
  std::vector<std::string> names;
  for (const core::Colormap& map : core::maps) names.emplace_back(map.name);
  return names;
}

Result<SiteColors> siteColors(const Sites& sites, const Diagram& cells, const RenderOptions& options) {
  VORPIPE_VAR(indices, core::paletteIndices(sites, cells, options, 0));
  VORPIPE_LET(palette, core::paletteOf(options, indices.key));
  SiteColors colors;
  colors.key = indices.key;
  if (!options.site_colors.empty()) {
    colors.rgba = options.site_colors;
    return colors;
  }
  colors.rgba.resize(sites.size());
  std::ranges::transform(indices.index, colors.rgba.begin(),
                         [&](std::uint8_t index) { return palette[index]; });
  return colors;
}

}  // namespace vorpipe
