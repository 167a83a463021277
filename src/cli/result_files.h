/// The files that `relax` and `transport` write for the present sites.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/drawing.h"
#include "cli/input.h"
#include "cli/options/picture_options.h"
#include "cli/options/result_outputs.h"
#include "cli/run_end.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// What is needed to make the files.
struct ResultJob {
  const ResultTargets& targets;
  const InputOptions& options;
  const PictureOptions& picture;
  const Input& input;
  const Density& density;  ///< for the masses of cells
  SearchOptions search;
  int threads;
  Surface surface = Surface::none;
};

/// Sites, with the parts that the files need.
struct ResultParts {
  Sites plane;                     ///< in the coordinates of the domain
  PlacedSites placed{};            ///< in the coordinates of files: in degrees if the input was
  std::optional<Diagram> cells{};  ///< likewise
  std::optional<Drawing> drawing{};
  RenderOptions render{};
};

/// Plans the memory of the files of sites, besides the run's own; `domain` if known.
void planFiles(MemoryPlan& plan, const Workload& work, const ResultTargets& targets,
               const PictureOptions& picture, const std::optional<Box>& domain);

/// Returns, before a backend is opened, the errors that computing cells or drawing pictures would.
Result<void> checkBefore(const ResultJob& job);

/// Returns which kinds of pictures are needed.
DrawingNeeds needsOf(const std::vector<PictureFile>& pictures);

/// Computes what the files need. Errors: those of Session::cells, pictureOf and draw.
Result<ResultParts> partsOf(Session& session, const ResultJob& job, const Sites& sites);

/// Returns a writer for each file of ResultTargets::paths(); they refer to both arguments.
std::vector<Writer> writersOf(const ResultJob& job, const ResultParts& parts);

/// Returns the rows of --trace; without `with_times`, only what is the same in every run.
std::string traceText(const std::vector<RelaxStep>& trace, bool with_times);

}  // namespace vorpipe::cli
