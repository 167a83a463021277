#include "motion/measured_sites.h"

#include <algorithm>
#include <cmath>

#include "base/block_sums.h"

namespace vorpipe::moving {
namespace {

/// The contribution of a block of sites to the totals.
struct Part {
  CarefulSum energy, scale, area;
  double farthest = 0;
  std::uint64_t cells = 0, lost = 0;
};

}  // namespace

MeasuredSites measureSites(const Sites& sites, const CellMoments& moments, const AllowedPlaces& allowed,
                           int threads) {
  const std::size_t count = sites.size();
  MeasuredSites measured;
  measured.gradient.resize(2 * count);
  measured.inverse.resize(2 * count);
  measured.way.resize(2 * count);
  const auto measureSite = [&](std::size_t i, Part& part) {
    const bool has_cell = moments.status[i] == Status::ok;
    const double mass = has_cell ? moments.mass[i] : 0;
    if (has_cell) ++part.cells;
    part.area.add(has_cell ? moments.area[i] : 0);
    if (!(mass > 0)) {
      ++part.lost;
      return;
    }
    const double x = sites.x[i], y = sites.y[i];
    const Point centroid = moments.centroid[i], target = allowed.nearestTo(centroid);
    const double dx = centroid.x - x, dy = centroid.y - y;
    const double own = moments.spread[i] + mass * (dx * dx + dy * dy);
    const double weighted = sites.weight.empty() ? 0 : mass * sites.weight[i];
    part.energy.add(own);
    part.energy.add(-weighted);
    part.scale.add(own + std::abs(weighted));
    measured.gradient[i] = -2 * mass * dx;
    measured.gradient[count + i] = -2 * mass * dy;
    measured.inverse[i] = measured.inverse[count + i] = 1 / (2 * mass);
    measured.way[i] = target.x - x;
    measured.way[count + i] = target.y - y;
    // hypot takes as long as all the rest, and few ways are the longest so far.
    const double side = std::max(std::abs(target.x - x), std::abs(target.y - y));
    if (1.5 * side > part.farthest) {
      part.farthest = std::max(part.farthest, std::hypot(target.x - x, target.y - y));
    }
  };
  const auto parts = byBlocks<Part>(count, threads, [&](std::size_t begin, std::size_t end) {
    Part part;
    for (auto i = begin; i < end; ++i) measureSite(i, part);
    return part;
  });
  Part all;
  for (const Part& part : parts) {
    all.energy.add(part.energy.value());
    all.scale.add(part.scale.value());
    all.area.add(part.area.value());
    all.farthest = std::max(all.farthest, part.farthest);
    all.cells += part.cells;
    all.lost += part.lost;
  }
  measured.energy = all.energy.value();
  measured.scale = all.scale.value();
  measured.area = all.area.value();
  measured.farthest = all.farthest;
  measured.cells = all.cells;
  measured.has_lost = all.lost > 0;
  return measured;
}

}  // namespace vorpipe::moving
