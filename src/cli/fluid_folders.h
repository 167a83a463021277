/// The output folders of `fluid`; a run resumed from a checkpoint continues them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/cells/fluid_series.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// Returns a name such as "step-000010.vtp".
std::string seriesFileOf(std::uint64_t step);

/// Opens the folder of a new series, creating it if needed. Errors (input): it cannot be made, or is not
/// empty.
Result<void> openSeries(const std::string& folder);

/// Returns the steps of a series up to the checkpoint's step; none if the folder is empty. Files of later
/// steps were written after the checkpoint, and will be overwritten. Errors (input): those of openSeries and
/// readSeries; the folder holds something else, or a series without this step.
Result<std::vector<SeriesStep>> goOnWithSeries(const std::string& folder, const FluidState& from);

/// The number of the next picture in a run that resumes from a checkpoint and draws one every `every` steps.
/// Picture 1 is that of step 0.
struct NextFrame {
  std::uint64_t number = 1;
  bool is_there = false;  ///< whether the picture of the checkpoint itself exists, just before the next
};

/// Examines the folder of these pictures, which may be empty. Errors (input): it holds something else, or not
/// exactly the pictures up to this step.
Result<NextFrame> goOnWithFrames(const std::string& folder, std::uint64_t step, std::uint64_t every);

}  // namespace vorpipe::cli
