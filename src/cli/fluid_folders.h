/// The folders that `fluid` writes into; a run that continues from a checkpoint continues them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/cells/fluid_series.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// "step-000010.vtp".
std::string seriesFileOf(std::uint64_t step);

/// Opens the folder of a new series, which is made where it is not there. Errors (input): it cannot be made,
/// or holds something.
Result<void> openSeries(const std::string& folder);

/// The steps of a series up to that of a checkpoint; none where the folder is empty. What is there of later
/// steps was written after the checkpoint, and will be written again. Errors (input): those of openSeries, of
/// readSeries; the folder holds something else, or a series without this step.
Result<std::vector<SeriesStep>> goOnWithSeries(const std::string& folder, const FluidState& from);

/// The number of the next picture of a run that continues from a checkpoint and has one every `every` steps:
/// 1 is that of step 0.
struct NextFrame {
  std::uint64_t number = 1;
  bool is_there = false;  ///< that of the checkpoint itself, before the next
};

/// Looks at the folder of these pictures, which may be empty. Errors (input): it holds something else, or
/// pictures that are not those up to this step.
Result<NextFrame> goOnWithFrames(const std::string& folder, std::uint64_t step, std::uint64_t every);

}  // namespace vorpipe::cli
