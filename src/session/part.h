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
  std::vector<std::uint8_t> own;      ///< 1: the cell is looked for
};

/// Those of a tile.
PartSites sitesOf(const SiteCells& cells, const TileBlock& tile, int threads);

/// Those that are named, of which `own` are looked for; both ascending, and the second among the first.
PartSites sitesOf(const SiteCells& cells, std::span<const std::uint32_t> all,
                  std::span<const std::uint32_t> own);

/// The cells that sites would have if there were no others.
struct PartCells {
  std::unique_ptr<SiteRun> run;
  AgreedCells agreed;  ///< records by index in the part
  Report report;
};

/// What makes the cells of a part those of the whole run to the last bit, where no other site cuts them: the
/// same scale, ties and order of sites.
struct PartFrame {
  PartOfRun prepared;
  bool has_order = false;  ///< `prepared.grid` puts the sites in the order of the run's bins
};

/// The frame of a tile, whose cells are clipped to it and what is around it; and of any sites, whose cells
/// are clipped to the whole domain.
PartFrame frameOf(const SiteCells& cells, const TileBlock& tile);
PartFrame frameOf(const SiteCells& cells);

/// Errors: as Session::cells'.
Result<PartCells> cellsOfPart(const Machine& machine, const SiteCells& cells, const PartSites& part,
                              PartFrame frame, const SearchOptions& search, const Progress& progress);

/// What there is to say of a cell of a part, by its index there.
CellMeasures measuresOf(const PartSites& part, const PartCells& cells, std::size_t i);

}  // namespace vorpipe::core
