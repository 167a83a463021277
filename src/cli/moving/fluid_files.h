/// What `fluid` writes while it runs: pictures, files for ParaView and checkpoints.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/options/fluid_options.h"
#include "cli/options/picture_options.h"
#include "io/files/output_file.h"
#include "io/fluid/fluid_series.h"
#include "view/recording/recorder.h"
#include "vorpipe.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// What colors of a picture stand for: `color`, or where there is none what is usual.
view::FlowColor flowColorOf(const FluidState& state, const PictureOptions& picture,
                            std::optional<view::FlowColor> color);

/// A picture of the cells; of a free surface the air is white.
Result<Image> drawFluid(Session& session, const FluidState& state, const FluidOptions& options,
                        const PictureOptions& picture, std::optional<view::FlowColor> color);

/// The header of --trace and its rows.
std::string traceHead();
std::string traceRow(const FluidStep& step, bool with_times);

/// Files that grow with the steps.
class FluidRecord {
 public:
  /// Opens films and folders; a run that goes on with a checkpoint goes on with them. Errors: those of
  /// openRecorder, openSeries, goOnWithFrames and goOnWithSeries.
  static Result<FluidRecord> open(const FluidTargets& targets, const PictureOptions& picture,
                                  const FluidState* resumed);

  /// Writes what there is to write of a step.
  Result<void> add(Session& session, const FluidState& state, const FluidOptions& options);
  /// Puts a film in place.
  Result<void> finish();

 private:
  FluidRecord(const FluidTargets& targets, const PictureOptions& picture)
      : targets_(&targets), picture_(&picture) {}
  Result<void> openFrames(const FluidState* resumed);
  Result<void> openSeries(const FluidState* resumed);
  Result<void> addToSeries(Session& session, const FluidState& state, const FluidOptions& options);

  const FluidTargets* targets_;
  const PictureOptions* picture_;
  std::unique_ptr<view::Recorder> recorder_;
  bool first_is_drawn_ = false;  ///< by the run that this one goes on with
  std::vector<SeriesStep> series_;
};

/// Refuses a checkpoint or a film that is one of the `files` at the end, or cannot be written, and files in
/// folders of frames or series, which hold nothing else. Errors (input) name the option.
Result<void> checkApart(const FluidTargets& targets, std::span<const OutputFile> files);

/// Writes a checkpoint, whole or not at all.
Result<void> saveCheckpoint(const std::string& path, const FluidState& state, const FluidOptions& options);

}  // namespace vorpipe::cli
