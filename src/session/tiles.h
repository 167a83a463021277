/// The tiles of a run over the lattice of sites: their blocks, their sites and cells, and which cells are
/// closed.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cells/agreed_cells.h"
#include "session/site_cells.h"

namespace vorpipe::core {

struct TileBlock {
  BinBlock own;             ///< cells of the lattice
  BinBlock with;            ///< and the cells around it
  std::uint64_t sites = 0;  ///< in `with`
};

/// Cuts the lattice into tiles of at most `usual` sites including surroundings, or of one cell. Omits tiles
/// without sites. Tiles have about as many sites as each other, not the same area.
std::vector<TileBlock> tilesOf(const SiteCells& cells, std::uint64_t usual);

/// Sites in the caller's units, in ascending order of their numbers.
struct PartSites {
  Sites sites;
  std::vector<std::uint32_t> number;  ///< in the whole run
  std::vector<std::uint8_t> own;      ///< 1: the cell is wanted
};

/// The sites of a tile and those around it.
PartSites sitesOf(const SiteCells& cells, const TileBlock& tile, int threads);

/// The sites `all`, of which the cells of `own` are wanted. Both ascend, and `own` is a subset of `all`.
PartSites sitesOf(const SiteCells& cells, std::span<const std::uint32_t> all,
                  std::span<const std::uint32_t> own);

/// The cells that sites would have if there were no other sites.
struct PartCells {
  std::unique_ptr<SiteRun> run;
  AgreedCells agreed;  ///< records by index in the part
  Report report;
};

/// Makes the cells of a part equal those of the whole run to the last bit, where no other site cuts them: by
/// the same scale, ties and order of sites.
struct PartFrame {
  PartOfRun prepared;
  bool has_order = false;  ///< `prepared.grid` puts the sites in the order of the run's bins
};

/// Returns the frame of a tile, whose cells are clipped to the tile and its surroundings. Without a tile,
/// returns the frame of any sites, whose cells are clipped to the whole domain.
PartFrame frameOf(const SiteCells& cells, const TileBlock& tile);
PartFrame frameOf(const SiteCells& cells);

/// Errors: those of Session::cells.
Result<PartCells> cellsOfPart(const Machine& machine, const SiteCells& cells, const PartSites& part,
                              PartFrame frame, const SearchOptions& search, const Progress& progress);

/// Returns the measures of a cell of a part, by its index there.
CellMeasures measuresOf(const PartSites& part, const PartCells& cells, std::size_t i);

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
