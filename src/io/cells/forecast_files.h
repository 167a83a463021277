/// Adds files and generators to a MemoryPlan.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/cells/cells_file.h"
#include "io/cells/edges_file.h"
#include "io/cells/space_file.h"
#include "io/pictures/picture_file.h"
#include "vorpipe.h"

namespace vorpipe {

/// Plans the `sites` sites of `--sites SPEC`, with or without weights of their own.
void planSites(MemoryPlan& plan, const std::string& spec, std::uint64_t sites, bool weighted);

/// The same in space.
void planSpaceSites(MemoryPlan& plan, const std::string& spec, std::uint64_t sites);

/// Plans attributes that were read and take this many bytes.
void planAttributes(MemoryPlan& plan, std::uint64_t bytes);

/// Plans readWeights of a file; or randomWeights if the path is empty.
void planWeights(MemoryPlan& plan, const std::string& path, std::uint64_t sites);

/// Plans readDensity.
void planDensity(MemoryPlan& plan, std::uint64_t pixels);

/// Plans writeCells, with attributes that take `attribute_bytes` bytes in memory.
void planCellsFile(MemoryPlan& plan, const Workload& work, const CellsFormat& format,
                   std::uint64_t attribute_bytes = 0);

/// Plans the memory that writeSpaceCells takes for the cells of `sites` sites.
void planSpaceFile(MemoryPlan& plan, std::uint64_t sites, const SpaceFormat& format);

/// Plans the writer of a picture's shapes; their cells are planned by planCells.
void planShapes(MemoryPlan& plan, const Workload& work, const RenderOptions& options);

/// Plans the writer of ids of a picture.
void planIdsFile(MemoryPlan& plan, const Workload& work, const IdsFormat& format, const PictureSize& size);
/// Plans topologyOf, and writeLines in each of these formats; nothing if there is none.
void planEdgesFiles(MemoryPlan& plan, const Workload& work, std::span<const EdgesFormat* const> formats);
/// The same for triangulationLines.
void planTriangulationFiles(MemoryPlan& plan, const Workload& work,
                            std::span<const EdgesFormat* const> formats);

}  // namespace vorpipe
