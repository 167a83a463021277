/// The input and output of a search in lanes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vorpipe::cpu {

/// Cells to find by the walk over the grid, and where to put them. Plain numbers: see lane_words.h.
struct LaneJob {
  const double *x, *y;                ///< the sites
  const std::uint32_t* offsets;       ///< of each bin
  double grid_xmin, grid_ymin, size;  ///< the grid
  int columns, rows;
  double domain[4], coverage[4];  ///< xmin, ymin, xmax, ymax
  float outset_x, outset_y;       ///< by which every line is moved outward
  int most;                       ///< sites to try before the search gives up
  const std::uint32_t* which;     ///< the cells' sites
  std::size_t count;              ///< of cells
  std::uint8_t* status;           ///< out: CellStatus of each
  std::int32_t* neighbors;        ///< out, unless null: those of each cell as in CellNeighbors
  std::uint8_t* neighbor_counts;  ///< out, unless null: how many
  const double* weight;           ///< of the sites, from here on: null where they have none
  const double* heaviest;         ///< as in Grid
  const std::uint32_t* heavy;     ///< as in SiteSet
  int heavy_count;
};

}  // namespace vorpipe::cpu
