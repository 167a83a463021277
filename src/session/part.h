/// Some of the sites of a run, and their cells.
#pragma once

#include <memory>
#include <vector>

#include "cells/agreed_cells.h"
#include "session/tile_blocks.h"

namespace vorpipe::core {

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

}  // namespace vorpipe::core
