/// Which cells of a part of the sites no other site can cut.
#pragma once

#include <array>
#include <vector>

#include "session/part.h"

namespace vorpipe::core {

/// What a tile knows all sites of, and where its own walls are those of the domain.
struct KnownBox {
  Box sites;                         ///< infinite where the tile ends with the run's grid
  std::array<bool, 4> true_walls{};  ///< by wall: xmin, xmax, ymin, ymax
  double longest;                    ///< distance of two sites below which ties are those of the whole domain
};

KnownBox knownBox(const SiteCells& cells, const TileBlock& tile);

/// The cells of a tile's own sites that others may cut, or that may lie elsewhere, ascending by their index
/// in the part: all others have every corner farther from sites that are not in the part than from their own.
std::vector<std::uint32_t> openCells(const PartSites& part, const PartCells& cells, const KnownBox& known,
                                     int threads);

/// The corner's center and its distance from the site, in scaled units.
struct CornerDisc {
  Point center;
  double radius;
};

/// The corners of some cells of a part, by index in the part: take(k, discs) for the k-th of them, on several
/// threads; duplicates and empty cells have none.
void eachCellsDiscs(const PartCells& cells, const std::vector<std::uint8_t>& wanted, int threads,
                    const std::function<void(std::uint32_t i, std::span<const std::int32_t> row,
                                             std::span<const CornerDisc> discs)>& take);

}  // namespace vorpipe::core
