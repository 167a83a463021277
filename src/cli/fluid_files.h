/// The files that `fluid` writes during a run: pictures, files for ParaView and checkpoints.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/fluid_trace.h"
#include "cli/input.h"
#include "cli/options/fluid_options.h"
#include "cli/options/picture_options.h"
#include "io/base/output_file.h"
#include "io/cells/fluid_series.h"
#include "view/recorder.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// Returns what the colors of a picture mean: `color`, or the usual choice if none is given.
view::FlowColor flowColorOf(const FluidState& state, const PictureOptions& picture,
                            std::optional<view::FlowColor> color);

/// Returns the options of the cells of a fluid.
CellsOptions cellsOptionsOf(const FluidOptions& options);

/// Returns the sites of a fluid in its domain.
Input inputOf(const FluidState& state, const FluidOptions& options);

/// The files that grow with each step.
class FluidRecord {
 public:
  /// Opens films, folders and the trace; a run that continues from a checkpoint continues folders and trace.
  /// Errors: those of openRecorder, readSeries and FluidTrace::open; (input) a folder holds something else.
  static Result<FluidRecord> open(const FluidTargets& targets, const PictureOptions& picture,
                                  const FluidState* resumed);

  /// Writes the files due at a step.
  Result<void> add(Session& session, const FluidState& state, const FluidOptions& options);
  /// Adds a row to the trace.
  Result<void> addRow(const FluidStep& step) { return trace_.add(step); }
  /// Puts a film in place and ends the trace.
  Result<void> finish(RunLog& log);

 private:
  FluidRecord(const FluidTargets& targets, const PictureOptions& picture, FluidTrace trace)
      : targets_(&targets), picture_(&picture), trace_(std::move(trace)) {}
  Result<void> openFrames(const FluidState* resumed);
  Result<void> openSeries(const FluidState* resumed);
  Result<void> addToSeries(Session& session, const FluidState& state, const FluidOptions& options);

  const FluidTargets* targets_;
  const PictureOptions* picture_;
  FluidTrace trace_;
  std::unique_ptr<view::Recorder> recorder_;
  bool first_is_drawn_ = false;  ///< by the run that this one resumes
  std::vector<SeriesStep> series_;
};

/// Rejects a checkpoint, trace or film that is also one of the final `files`, or cannot be written. Also
/// rejects files in the folders of frames or series, which may hold nothing else. Errors (input) name the
/// option.
Result<void> checkApart(const FluidTargets& targets, std::span<const OutputFile> files);

}  // namespace vorpipe::cli
