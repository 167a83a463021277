#include "domain/cell_mass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/refusal.h"
#include "base/try.h"
#include "cells/cell_walk.h"
#include "sites/grid.h"

namespace vorpipe::core {
namespace {

constexpr std::size_t own_corners_grain = 4096;

/// Weighs cells of the set by their own corners.
class OwnMasses {
 public:
  OwnMasses(const OwnCorners& cells, const DensityPixels& pixels, const MassRecords& records)
      : cells_(cells), records_(records), weighing_(pixels, records) {}

  void weigh(std::uint32_t cell, std::span<const AnchoredPoint> corners) {
    const auto i = cells_.set.id[cell];
    if (i >= cells_.places.size()) return;
    if (!(records_.area[i] > 0)) return weighing_.weighNothing(i);
    const ClippedCell* const part = cells_.parts != nullptr ? cells_.parts->of(cell) : nullptr;
    if (part != nullptr) return weighPart(i, *part);
    const Point origin = measuringOrigin(cells_.set, cell, corners.front());
    points_.clear();
    for (const auto& corner : corners) points_.push_back(cells_.unscale(relativeTo(origin, corner)));
    weighing_.weigh(i, placeOf(i, cell, origin), points_);
  }

 private:
  void weighPart(std::size_t i, const ClippedCell& part) {
    points_.clear();
    for (const Point p : part.vertices) points_.push_back(cells_.unscale(p));
    weighing_.weigh(i, {0, 0}, points_, [&](const auto& take) {
      for (std::size_t r = 0; r < part.ring_starts.size(); ++r) {
        eachSide(std::span(points_).subspan(part.ring_starts[r], part.ring(r).size()), take);
      }
    });
  }

  /// The origin in the caller's coordinates.
  [[nodiscard]] Point placeOf(std::size_t i, std::uint32_t cell, Point origin) const {
    const Point away{origin.x - cells_.set.x[cell], origin.y - cells_.set.y[cell]};
    const Point way = cells_.unscale(away);
    return {cells_.places.x[i] + way.x, cells_.places.y[i] + way.y};
  }

  const OwnCorners& cells_;
  const MassRecords& records_;
  Weighing weighing_;
  std::vector<Point> points_;
};

tl::unexpected<Error> refuseDensity(const std::string& what) {
  return tl::unexpected(refusalOf(Subject::density, what));
}

}  // namespace

OwnCorners ownCorners(const FoundCells& found, const CellsOptions& options, const Sites& places,
                      int threads) {
  const SiteRun& run = *found.run;
  const int scaled = options.periodic == Periodic::none ? 0 : scaleExponent(options.domain);
  return {run.prepared.set, *run.cells, Unscale(run.prepared.exponent + scaled),
          places,           threads,    &found.parts};
}

void weighCells(const OwnCorners& cells, const DensityPixels& pixels, const MassRecords& records) {
  const auto count = cells.set.size();
  parallelFor(
      count, grainFor(count, own_corners_grain), cells.threads, [&](std::size_t begin, std::size_t end) {
        OwnMasses masses(cells, pixels, records);
        CellWalk walk(cells.set, cells.rows);
        walk(begin, end, [&](std::uint32_t cell, auto, auto corners) { masses.weigh(cell, corners); });
      });
}

Result<void> checkDensity(const Density& density) {
  if (density.width < 1 || density.height < 1) {
    return refuseDensity(
        fmt::format("{}x{} pixels; each side must be 1 or more", density.width, density.height));
  }
  const auto width = static_cast<std::size_t>(density.width);
  const std::size_t pixels = width * static_cast<std::size_t>(density.height);
  if (density.values.size() != pixels) {
    return refuseDensity(
        fmt::format("{} values for {}x{} pixels", density.values.size(), density.width, density.height));
  }
  if (const auto& box = density.box) {
    const double across = box->xmax - box->xmin, along = box->ymax - box->ymin;
    if (!(across > 0) || !(along > 0) || !std::isfinite(across) || !std::isfinite(along)) {
      return refuseDensity(
          fmt::format("its place {},{},{},{} is no box", box->xmin, box->ymin, box->xmax, box->ymax));
    }
  }
  const auto wrong =
      std::ranges::find_if_not(density.values, [](double v) { return std::isfinite(v) && v >= 0; });
  if (wrong == density.values.end()) return {};
  const auto pixel = static_cast<std::size_t>(wrong - density.values.begin());
  return refuseDensity(
      fmt::format("row {}, column {} (counted from 0) is {}, not a finite number of 0 or more", pixel / width,
                  pixel % width, *wrong));
}

Result<void> measureMass(const CellsOptions& options, const Sites& sites, int threads, FoundCells& found) {
  const DensityPixels pixels(options.density, options.domain, options.periodic);
  Sites placed;
  const bool repeats = options.periodic != Periodic::none;
  if (repeats) {
    VORPIPE_VAR(made, wrapped(sites, options.domain, options.periodic, threads));
    placed = std::move(made);
  }
  Diagram& d = found.diagram;
  d.mass.resize(d.size());
  d.mass_centroid = d.centroid;
  const OwnCorners cells = ownCorners(found, options, repeats ? placed : sites, threads);
  weighCells(cells, pixels, {d.area, d.mass, d.mass_centroid});
  return {};
}

}  // namespace vorpipe::core
