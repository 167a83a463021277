/// Cells that reach beyond the surroundings of their tile.
#pragma once

#include <functional>
#include <vector>

#include "session/tiles.h"

namespace vorpipe::core {

/// Sites whose cells are open, and their neighbors known so far. Numbers are those in the whole run, in any
/// order.
struct OpenCells {
  std::vector<std::uint32_t> sites, around;
};

/// Finds the cells of some sites on a device.
using FindPart = std::function<Result<PartCells>(const PartSites& part, const PartFrame& frame)>;

/// Settles cells: finds them among their neighbors, adds sites that are nearer to their corners than their
/// own sites, and repeats until there are none. Calls settled(part, cells, which) with settled cells, in
/// batches. Error (input): this takes more than `most` sites at a time.
Result<void> settleOpenCells(
    const SiteCells& cells, OpenCells open, std::uint64_t most, int threads, const FindPart& find,
    const std::function<Result<void>(const PartSites& part, const PartCells& found,
                                     std::span<const std::uint32_t> which)>& settled);

}  // namespace vorpipe::core
