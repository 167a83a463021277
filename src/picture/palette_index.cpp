#include "picture/palette_index.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/try.h"
#include "picture/color_scale.h"
#include "picture/colormap.h"

namespace vorpipe::core {
namespace {

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

}  // namespace

Result<PaletteIndices> paletteIndices(const Sites& sites, const Diagram& cells, const RenderOptions& options,
                                      int threads) {
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
  const auto places =
      ColorPlaces::of({options.color, options.color_scale, options.color_range}, std::move(values), threads);
  if (!places) return tl::unexpected(places.error());
  PaletteIndices indices{std::vector<std::uint8_t>(sites.size()), places->key()};
  parallelFor(sites.size(), palette_index_grain, threads, [&](std::size_t begin, std::size_t end) {
    for (auto i = begin; i < end; ++i) {
      if (hasCell(i)) indices.index[i] = places->colorOf(valueOf(i));
    }
  });
  return indices;
}

}  // namespace vorpipe::core

namespace vorpipe {

Result<SiteColors> siteColors(const Sites& sites, const Diagram& cells, const RenderOptions& options) {
  const auto palette = core::paletteByName(options.colormap);
  if (!palette) return tl::unexpected(palette.error());
  auto indices = core::paletteIndices(sites, cells, options, 0);
  if (!indices) return tl::unexpected(indices.error());
  SiteColors colors;
  colors.key = indices->key;
  colors.rgba.resize(sites.size());
  std::ranges::transform(indices->index, colors.rgba.begin(),
                         [&](std::uint8_t index) { return (*palette)[index]; });
  return colors;
}

}  // namespace vorpipe
