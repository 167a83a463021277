#include "core/picture/palette_index.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::core {
namespace {

/// How many sites a cell has as neighbors; with an outline, one may have several edges.
double neighborsOf(const Diagram& cells, std::uint32_t site) {
  const auto* neighbors = cells.neighbors.data();
  std::vector<std::int64_t> sites(neighbors + cells.cell_offsets[site],
                                  neighbors + cells.cell_offsets[site + std::size_t{1}]);
  std::erase_if(sites, [](std::int64_t neighbor) { return neighbor < 0; });
  std::ranges::sort(sites);
  return static_cast<double>(std::unique(sites.begin(), sites.end()) - sites.begin());
}

std::vector<std::uint8_t> scaledToPalette(const std::vector<double>& values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double range = *greatest - *least;
  std::vector<std::uint8_t> palette_indices(values.size());
  std::transform(values.begin(), values.end(), palette_indices.begin(), [&](double value) {
    return range > 0 ? static_cast<std::uint8_t>(std::lround(255 * ((value - *least) / range)))
                     : std::uint8_t{128};
  });
  return palette_indices;
}

}  // namespace

Result<std::vector<std::uint8_t>> paletteIndices(ColorBy color, const Sites& sites,
                                                 std::span<const std::uint32_t> ids, const Diagram& cells) {
  if (color == ColorBy::site) {
    std::vector<std::uint8_t> palette_indices(ids.size());
    std::transform(ids.begin(), ids.end(), palette_indices.begin(), [&](std::uint64_t id) {
      return static_cast<std::uint8_t>(256 * id / (sites.size() + 1));
    });
    return palette_indices;
  }
  if (color == ColorBy::weight && sites.weight.empty()) {
    return tl::unexpected(Error{ErrorCode::input, "color by weight: the sites have no weights"});
  }
  std::vector<double> values(ids.size());
  std::transform(ids.begin(), ids.end(), values.begin(), [&](std::uint32_t id) {
    if (color == ColorBy::weight) return sites.weight[id];
    return color == ColorBy::area ? cells.area[id] : neighborsOf(cells, id);
  });
  return scaledToPalette(values);
}

}  // namespace vorpipe::core
