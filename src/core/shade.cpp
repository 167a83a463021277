#include "core/shade.h"

#include <algorithm>
#include <cmath>

namespace vorpipe {
namespace {

double neighborsOf(const Diagram& cells, std::uint32_t site) {
  const auto* neighbors = cells.neighbors.data();
  const auto count = std::count_if(neighbors + cells.cell_offsets[site],
                                   neighbors + cells.cell_offsets[site + std::size_t{1}],
                                   [](std::int64_t neighbor) { return neighbor >= 0; });
  return static_cast<double>(count);
}

std::vector<std::uint8_t> scaledToPalette(const std::vector<double>& values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double range = *greatest - *least;
  std::vector<std::uint8_t> shades(values.size());
  std::transform(values.begin(), values.end(), shades.begin(), [&](double value) {
    return range > 0 ? static_cast<std::uint8_t>(std::lround(255 * ((value - *least) / range)))
                     : std::uint8_t{128};
  });
  return shades;
}

}  // namespace

Result<std::vector<std::uint8_t>> shadesOf(ColorBy color, const Sites& sites, const SiteSet& set,
                                           const Diagram& cells) {
  if (color == ColorBy::site) {
    std::vector<std::uint8_t> shades(set.size());
    std::transform(set.id.begin(), set.id.end(), shades.begin(), [&](std::uint64_t id) {
      return static_cast<std::uint8_t>(256 * id / (sites.size() + 1));
    });
    return shades;
  }
  if (color == ColorBy::weight && sites.weight.empty()) {
    return tl::unexpected(Error{ErrorCode::input, "color by weight: the sites have no weights"});
  }
  std::vector<double> values(set.size());
  std::transform(set.id.begin(), set.id.end(), values.begin(), [&](std::uint32_t id) {
    if (color == ColorBy::weight) return sites.weight[id];
    return color == ColorBy::area ? cells.area[id] : neighborsOf(cells, id);
  });
  return scaledToPalette(values);
}

}  // namespace vorpipe
