#include "domain/cell_mass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/refusal.h"

namespace vorpipe::core {
namespace {

tl::unexpected<Error> refuseDensity(const std::string& what) {
  return tl::unexpected(refusalOf(Subject::density, what));
}

}  // namespace

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
    auto made = wrapped(sites, options.domain, options.periodic, threads);
    if (!made) return tl::unexpected(made.error());
    placed = std::move(*made);
  }
  Diagram& d = found.diagram;
  d.mass.resize(d.size());
  d.mass_centroid = d.centroid;
  const OwnCorners cells = ownCorners(found, options, repeats ? placed : sites, threads);
  weighCells(cells, pixels, {d.area, d.mass, d.mass_centroid});
  return {};
}

}  // namespace vorpipe::core
