/// Sites of a periodic domain, and cells of them and their images.
#pragma once

#include "checked_runs.h"
#include "core/periodic/images.h"

namespace vorpipe::test {

using namespace core;

inline constexpr Box unit{0, 0, 1, 1};

inline PeriodicSites placed(const Sites& sites, const Box& domain = unit, Periodic periodic = Periodic::xy) {
  return std::move(*placeSites(sites, domain, periodic, 2));
}

inline CellsOptions periodicCells(Periodic periodic = Periodic::xy, Detail detail = Detail::everything) {
  CellsOptions options = unit_cells;
  options.periodic = periodic;
  options.detail = detail;
  return options;
}

/// Cells of sites and images, as far as `band` goes.
inline Diagram imagedCells(const ImagedSites& imaged) {
  CellsOptions options = unit_cells;
  options.domain = imaged.box;
  options.detail = Detail::polygons;
  return cellsOf(imaged.sites, options);
}

}  // namespace vorpipe::test
