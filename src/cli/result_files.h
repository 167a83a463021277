/// What `relax` and `transport` have in common: sites under a density, and files of the resulting sites.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/input.h"
#include "cli/options/density_options.h"
#include "cli/options/picture_options.h"
#include "cli/options/result_outputs.h"
#include "cli/run.h"
#include "io/sites/photograph_file.h"
#include "view/recorder.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct SitesOptions : RunOptions {
  InputOptions input;
  PictureOptions picture;
  ResultTargets targets;
  DensityOptions density;
};

/// A run over sites under a density. Set `surface` and how to read the input before load().
struct SitesRun : CommandRun {
  SitesRun(std::string name, const SitesOptions& from, const Invocation& invocation,
           std::vector<std::string> output_paths)
      : CommandRun(std::move(name), from, invocation, std::move(output_paths)),
        command(from),
        source(from.input) {}

  /// Reads the density; reads, generates or samples the sites. `--sites density:N` samples N sites from the
  /// density, in the box of its pixels if no domain is given. `plan` is called with the density known.
  /// Errors: those of readDensity, CommandRun::load and placeDensity; (input) there is no density, or the
  /// domain is to come from sites to be sampled.
  Result<void> load(const PlanRun& plan);

  /// Returns, before a backend is opened, the errors that computing cells or drawing pictures would; then
  /// begins the run. From now on, a signal lets it end with a partial result.
  Result<void> begin(const PlanRun& plan);

  /// Plans the memory of the density, and completes the workload.
  void planDensityOf(MemoryPlan& plan, Workload& work) const;
  /// Plans the memory of the files of sites, besides the run's own.
  void planFiles(MemoryPlan& plan, const Workload& work) const;

  /// Writes the files of the resulting sites, then those of `output`; adds the sums of files of cells to its
  /// figures. Errors: those of Session::cells, pictureOf, draw and CommandRun::write.
  Result<void> write(const Sites& sites, RunOutput output);

  /// Opens ResultTargets::frames; null if there are none. Errors, with the option's name: those of
  /// openRecorder; another output lies in the folder.
  Result<std::unique_ptr<view::Recorder>> openFrames() const;
  /// Draws a frame. Errors: those of pictureOf, takeColors and draw.
  Result<Image> frameOf(const Sites& sites);

  /// Writes the files of ResultTargets::numberedPaths. Errors likewise, and those of createOutputs.
  Result<void> writeNumbered(const Sites& sites, std::uint64_t number);

  const SitesOptions& command;
  InputOptions source;  ///< of the input; a generator in place of `density:N`
  Surface surface = Surface::none;
  PhotographFile photograph{};   ///< of the pictures
  DensityFile density{};         ///< empty until it is loaded, or if there is none
  std::optional<Input> input{};  ///< once it is loaded
};

/// Returns a writer of --trace: `text` makes its rows, without times if asked.
template <class Step>
Writer traceWriter(RunLog& log, const std::vector<Step>& trace,
                   std::string (*text)(const std::vector<Step>&, bool with_times)) {
  return [&, text](ByteSink& to) {
    return log.writeTimed(to, [&](bool with_times) { return text(trace, with_times); });
  };
}

}  // namespace vorpipe::cli
