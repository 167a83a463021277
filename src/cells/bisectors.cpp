#include "cells/bisectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t bisectors_grain = 4096;
/// Farther than anything that can cut (FAR in cell.glsl); keeps float arithmetic finite.
constexpr double farthest = 1e30;

template <class Real>
Real roundedDown(double value) {
  constexpr auto largest = static_cast<double>(std::numeric_limits<Real>::max());
  return static_cast<Real>(
      std::min(value * (1 - 2 * static_cast<double>(std::numeric_limits<Real>::epsilon())), largest));
}

template <class Real>
Real roundedUp(double value) {
  return static_cast<Real>(value * (1 + 2 * static_cast<double>(std::numeric_limits<Real>::epsilon())));
}

double length(double x, double y) {
  const double squared = x * x + y * y;
  return squared > 1e-280 && squared < 1e280 ? std::sqrt(squared) : std::hypot(x, y);
}

/// The bisector of two sites, seen from an origin that lies at (-origin_offset.x, -origin_offset.y) from the
/// first. With weights, a site's distance bounds nothing.
template <class Real>
HalfPlane<Real> bisector(const SiteSet& sites, std::uint32_t site, std::uint32_t other, Point origin_offset) {
  const double x = sites.x[other] - sites.x[site], y = sites.y[other] - sites.y[site];
  const double distance = length(x, y);
  const double nx = x / distance;
  const double ny = y / distance;
  double h = 0.5 * distance + (origin_offset.x * nx + origin_offset.y * ny);
  double bound = distance;
  if (!sites.weight.empty()) {
    h += 0.5 * (sites.weight[site] - sites.weight[other]) / distance;
    bound = 0;
  }
  return {static_cast<Real>(nx), static_cast<Real>(ny), static_cast<Real>(std::clamp(h, -farthest, farthest)),
          roundedDown<Real>(bound)};
}

/// The domain, seen from the origin of a cell.
Box domainFrom(const SiteSet& sites, Point origin) {
  const auto& d = sites.domain;
  return {d.xmin - origin.x, d.ymin - origin.y, d.xmax - origin.x, d.ymax - origin.y};
}

}  // namespace

Point cellOrigin(const SiteSet& sites, std::uint32_t site) {
  return {std::clamp(sites.x[site], sites.domain.xmin, sites.domain.xmax),
          std::clamp(sites.y[site], sites.domain.ymin, sites.domain.ymax)};
}

template <class Real>
void packBatch(const SiteSet& sites, const Candidates& candidates, std::size_t begin, std::size_t end,
               int threads, CellBatch<Real>& out) {
  const auto first_line = candidates.offsets[begin];
  out.entries.resize(end - begin);
  out.lines.resize(candidates.offsets[end] - first_line);
  parallelFor(end - begin, bisectors_grain, threads, [&](std::size_t from, std::size_t to) {
    for (std::size_t e = from; e < to; ++e) {
      const auto site = candidates.site[begin + e];
      const auto origin = cellOrigin(sites, site);
      const Point origin_offset{sites.x[site] - origin.x, sites.y[site] - origin.y};
      const Box walls = domainFrom(sites, origin);
      const auto first = candidates.offsets[begin + e];
      const auto last = candidates.offsets[begin + e + 1];
      out.entries[e] = {first - first_line,
                        last - first,
                        static_cast<Real>(walls.xmin),
                        static_cast<Real>(walls.ymin),
                        static_cast<Real>(walls.xmax),
                        static_cast<Real>(walls.ymax),
                        roundedDown<Real>(candidates.reach[begin + e]),
                        roundedUp<Real>(std::min(length(origin_offset.x, origin_offset.y), farthest))};
      for (auto c = first; c < last; ++c) {
        const auto other = candidates.index[c];
        out.lines[c - first_line] = bisector<Real>(sites, site, other, origin_offset);
      }
    }
  });
}

template void packBatch(const SiteSet&, const Candidates&, std::size_t, std::size_t, int, CellBatch<float>&);
template void packBatch(const SiteSet&, const Candidates&, std::size_t, std::size_t, int, CellBatch<double>&);

}  // namespace vorpipe::core
