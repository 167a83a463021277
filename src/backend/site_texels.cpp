#include "backend/site_texels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "layout.glsl"

namespace vorpipe {
namespace {

// Longer searches are left to the exact search, whose tree is no slower where sites crowd in few bins.
constexpr std::int32_t most_tried = 512;
// If weights differ by much more than the square of a spacing, cells have many spacings to search.
constexpr std::int32_t most_tried_weighted = 4096;

// Represents infinity, which shaders need not support; FAR of cell.glsl.
constexpr double far = 1e30;

static_assert(most_heavy == MOST_HEAVY);

constexpr std::size_t sites_at_once = std::size_t{1} << 14;

Point centerOf(const Box& box) { return {(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2}; }

struct Split {
  float high, low;
};

Split split(double value) {
  const double bounded = std::clamp(value, -far, far);
  const auto high = static_cast<float>(bounded);
  return {high, static_cast<float>(bounded - static_cast<double>(high))};
}

SiteTexel fromCenter(const Point& center, double x, double y) {
  const Split at_x = split(x - center.x);
  const Split at_y = split(y - center.y);
  return {at_x.high, at_y.high, at_x.low, at_y.low};
}

void splitBox(const Point& center, const Box& box, float (&high)[4], float (&low)[4]) {
  const double sides[4] = {box.xmin - center.x, box.ymin - center.y, box.xmax - center.x,
                           box.ymax - center.y};
  for (std::size_t k = 0; k < 4; ++k) {
    const Split side = split(sides[k]);
    high[k] = side.high;
    low[k] = side.low;
  }
}

template <class Texel, class Make>
void writeAll(std::size_t count, std::byte* to, const Make& make) {
  parallelEach(count, sites_at_once, 0, [&](std::size_t i) {
    const Texel texel = make(i);
    std::memcpy(to + i * sizeof(Texel), &texel, sizeof(Texel));
  });
}

}  // namespace

SiteTexel siteTexel(const Box& domain, Point from, Point p) {
  const Point center = centerOf(domain);
  return fromCenter({}, (from.x - center.x) + p.x, (from.y - center.y) + p.y);
}

SiteGridUniform siteGridUniform(const SiteSet& sites) {
  const Point center = centerOf(sites.domain);
  const Grid& grid = sites.grid;
  SiteGridUniform block{};
  splitBox(center, sites.domain, block.domain_high, block.domain_low);
  splitBox(center, sites.coverage, block.coverage_high, block.coverage_low);
  block.corner = fromCenter(center, grid.xmin, grid.ymin);
  block.size = static_cast<float>(grid.size);
  // The corner relative to an origin, the size of a bin, their product with an index and the sum are rounded.
  // Each error is at most 2^-24 of the longest distance from the origin to a corner of the grid; a quotient
  // by that size is off by five times as much. A device that sorts sites into bins uses another quotient, of
  // a distance that is up to twice as long.
  block.slack = 0x1p-19F;
  block.columns = static_cast<std::int32_t>(grid.columns);
  block.rows = static_cast<std::int32_t>(grid.rows);
  block.most = sites.weight.empty() ? most_tried : most_tried_weighted;
  assert(sites.heavy.size() <= most_heavy);
  block.heavy_count = static_cast<std::int32_t>(sites.heavy.size());
  std::ranges::copy(sites.heavy, std::begin(block.heavy));
  return block;
}

void writeSiteTexels(const SiteSet& sites, std::byte* to) {
  const Point center = centerOf(sites.domain);
  writeAll<SiteTexel>(sites.size(), to,
                      [&](std::size_t i) { return fromCenter(center, sites.x[i], sites.y[i]); });
}

void writeSiteMarks(const SiteSet& sites, std::span<const std::uint8_t> palette_index, std::byte* to) {
  assert(palette_index.size() == sites.size());
  writeAll<SiteMark>(sites.size(), to, [&](std::size_t i) {
    return SiteMark{sites.id[i], palette_index[i]};
  });
}

void writeWeightTexels(const SiteSet& sites, std::byte* to) {
  writeAll<WeightTexel>(sites.size(), to, [&](std::size_t i) {
    const Split weight = split(sites.weight[i]);
    return WeightTexel{weight.high, weight.low};
  });
}

std::size_t heaviestBytes(const SiteSet& sites) {
  constexpr std::size_t texel = 4;
  return (sites.grid.heaviest.size() + texel - 1) / texel * texel * sizeof(float);
}

void writeHeaviest(const SiteSet& sites, std::byte* to) {
  const std::vector<double>& heaviest = sites.grid.heaviest;
  writeAll<float>(heaviestBytes(sites) / sizeof(float), to, [&](std::size_t number) {
    if (number >= heaviest.size()) return 0.0F;
    // Shaders hold a weight with a relative error of 2^-48.
    const double bound = std::clamp(heaviest[number] + std::abs(heaviest[number]) * 0x1p-46, -far, far);
    const auto rounded = static_cast<float>(bound);
    return static_cast<double>(rounded) < bound ? std::nextafter(rounded, std::numeric_limits<float>::max())
                                                : rounded;
  });
}

}  // namespace vorpipe
