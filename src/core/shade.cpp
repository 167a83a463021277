#include "core/shade.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/host_search.h"

namespace vorpipe {
namespace {

constexpr std::size_t cells_at_once = std::size_t{1} << 16;
/// An edge shorter than this part of the distance between its two sites is a tie: no neighbor.
constexpr double shortest_edge = 1e-6;

double areaOf(const CellPolygons& cells, std::size_t e) {
  double twice = 0;
  const auto begin = cells.first[e];
  const auto end = cells.first[e + 1];
  for (auto v = begin; v < end; ++v) {
    const auto next = v + 1 < end ? v + 1 : begin;
    twice += cells.x[v] * cells.y[next] - cells.x[next] * cells.y[v];
  }
  return 0.5 * twice;
}

double neighborsOf(const SiteSet& sites, const HostCells& found, std::size_t e) {
  const auto& cells = found.polygons;
  const auto site = found.candidates.site[e];
  const auto begin = cells.first[e];
  const auto end = cells.first[e + 1];
  int count = 0;
  for (auto v = begin; v < end; ++v) {
    if (cells.line[v] < 0) continue;
    const auto next = v + 1 < end ? v + 1 : begin;
    const auto other =
        found.candidates.index[found.candidates.first[e] + static_cast<std::uint32_t>(cells.line[v])];
    const double length = std::hypot(cells.x[next] - cells.x[v], cells.y[next] - cells.y[v]);
    const double distance = std::hypot(sites.x[other] - sites.x[site], sites.y[other] - sites.y[site]);
    if (length >= shortest_edge * distance) ++count;
  }
  return count;
}

Result<std::vector<double>> measureCells(ColorBy color, const SiteSet& set, const FlannSearch& search,
                                         Backend& judge, int threads, const Progress& progress) {
  std::vector<double> values(set.size());
  std::vector<std::uint32_t> which(set.size());
  std::iota(which.begin(), which.end(), 0u);
  for (std::size_t begin = 0; begin < which.size(); begin += cells_at_once) {
    if (progress && !progress("measures", static_cast<double>(begin) / static_cast<double>(which.size()))) {
      return tl::unexpected(Error{ErrorCode::cancelled, "interrupted"});
    }
    const auto count = std::min(cells_at_once, which.size() - begin);
    const auto cells = findCells(set, search, judge, std::span(which).subspan(begin, count), threads);
    if (!cells) return tl::unexpected(cells.error());
    for (std::size_t e = 0; e < count; ++e) {
      values[cells->candidates.site[e]] =
          color == ColorBy::area ? areaOf(cells->polygons, e) : neighborsOf(set, *cells, e);
    }
  }
  return values;
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
                                           const FlannSearch& search, Backend& judge, int threads,
                                           const Progress& progress) {
  if (color == ColorBy::site) {
    std::vector<std::uint8_t> shades(set.size());
    std::transform(set.id.begin(), set.id.end(), shades.begin(), [&](std::uint64_t id) {
      return static_cast<std::uint8_t>(256 * id / (sites.size() + 1));
    });
    return shades;
  }
  if (color == ColorBy::weight) {
    if (sites.weight.empty()) {
      return tl::unexpected(Error{ErrorCode::input, "color by weight: the sites have no weights"});
    }
    std::vector<double> values(set.size());
    std::transform(set.id.begin(), set.id.end(), values.begin(), [&](auto id) { return sites.weight[id]; });
    return scaledToPalette(values);
  }
  const auto values = measureCells(color, set, search, judge, threads, progress);
  if (!values) return tl::unexpected(values.error());
  return scaledToPalette(*values);
}

}  // namespace vorpipe
