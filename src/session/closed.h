/// Finds the cells of a part of the sites that no other site can cut.
#pragma once

#include <array>
#include <vector>

#include "session/part.h"

namespace vorpipe::core {

/// The box in which a tile has all sites, and which of its walls are walls of the domain.
struct KnownBox {
  Box sites;                         ///< infinite where the tile reaches the end of the run's grid
  std::array<bool, 4> true_walls{};  ///< by wall: xmin, xmax, ymin, ymax
  double longest;                    ///< ties between sites closer than this are those of the whole domain
};

KnownBox knownBox(const SiteCells& cells, const TileBlock& tile);

/// Returns the open cells of a tile's own sites, ascending by index in the part. Other sites may cut them, or
/// they may lie in another tile. In all other cells, each corner is farther from sites outside the part than
/// from its own site.
std::vector<std::uint32_t> openCells(const PartSites& part, const PartCells& cells, const KnownBox& known,
                                     int threads);

/// The place of a cell's corner and its distance from the site, in scaled units.
struct CornerDisc {
  Point center;
  double radius;
};

/// Calls take(i, row, discs) with the corners of each wanted cell of a part, by index i in the part, on
/// several threads. Duplicates and empty cells have no corners.
void eachCellsDiscs(const PartCells& cells, const std::vector<std::uint8_t>& wanted, int threads,
                    const std::function<void(std::uint32_t i, std::span<const std::int32_t> row,
                                             std::span<const CornerDisc> discs)>& take);

}  // namespace vorpipe::core
