#include "picture/palette.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "base/try.h"
#include "picture/color_scale.h"

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

/// Refuses options that a picture by site cannot show.
Result<void> checkNoScale(const RenderOptions& options) {
  const auto refuse = [](std::string_view what) {
    return tl::unexpected(
        Error{ErrorCode::input, std::string(what) + ": colors by site stand for no values"});
  };
  if (options.color_scale != ColorScale::automatic) return refuse("color scale");
  if (options.color_range) return refuse("color range");
  if (options.legend) return refuse("legend");
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

Result<PaletteIndices> paletteIndices(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                      int threads) {
  VORPIPE_TRY(checkOwnColors(sites, options));
  if (options.color == ColorBy::site) {
    VORPIPE_TRY(checkNoScale(options));
    return PaletteIndices{indicesBySite(sites.size()), {}};
  }
  if (options.color == ColorBy::weight && sites.weight.empty()) {
    return tl::unexpected(Error{ErrorCode::input, "color by weight: the sites have no weights"});
  }
  const auto hasCell = [&](std::size_t i) { return cells.status.empty() || cells.status[i] == Status::ok; };
  const auto valueOf = [&](std::size_t i) {
    if (options.color == ColorBy::weight) return sites.weight[i];
    return options.color == ColorBy::area ? cells.area[i] : neighborsOf(cells, i);
  };
  std::vector<double> values;
  values.reserve(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (hasCell(i)) values.push_back(valueOf(i));
  }
  VORPIPE_LET(places, ColorPlaces::of({options.color, options.color_scale, options.color_range},
                                      std::move(values), threads));
  PaletteIndices indices{std::vector<std::uint8_t>(sites.size()), places.key()};
  parallelFor(sites.size(), palette_index_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      if (hasCell(i)) indices.index[i] = places.colorOf(valueOf(i));
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
  VORPIPE_LET(palette, core::paletteByName(options.colormap));
  VORPIPE_VAR(indices, core::paletteIndices(sites, cells, options, 0));
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
