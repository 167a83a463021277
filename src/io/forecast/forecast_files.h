/// What files and generators add to a MemoryPlan.
#pragma once

#include <string>

#include "io/cells/cells_file.h"
#include "io/pictures/picture_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// Plans the sites of `--sites SPEC`, of which there are `sites`, with or without weights of their own.
void planSites(MemoryPlan& plan, const std::string& spec, std::uint64_t sites, bool weighted);

/// Plans readWeights of a file; or randomWeights, where the path is empty.
void planWeights(MemoryPlan& plan, const std::string& path, std::uint64_t sites);

/// Plans readDensity.
void planDensity(MemoryPlan& plan, std::uint64_t pixels);

/// Plans writeCells.
void planCellsFile(MemoryPlan& plan, const Workload& work, const CellsFormat& format);

/// Plans the writer of a picture's shapes; their cells are planned by planCells.
void planShapes(MemoryPlan& plan, const Workload& work, ColorBy color, bool dots);

/// Plans the writer of ids of a picture.
void planIdsFile(MemoryPlan& plan, const Workload& work, const IdsFormat& format, const PictureSize& size);

}  // namespace vorpipe
