/// The files that `relax` and `transport` write of sites as they stand.
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

/// What files are made with.
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

/// Sites, with what the files want of them.
struct ResultParts {
  Sites plane;                     ///< as they stand in the domain
  PlacedSites placed{};            ///< as files have them: in degrees, where the input was
  std::optional<Diagram> cells{};  ///< likewise
  std::optional<Drawing> drawing{};
  RenderOptions render{};
};

/// Plans what the files of sites take, beside what the run itself does; `domain` as far as it is known.
void planFiles(MemoryPlan& plan, const Workload& work, const ResultTargets& targets,
               const PictureOptions& picture, const std::optional<Box>& domain);

/// Refuses, before a backend is opened, what computing cells or drawing pictures would.
Result<void> checkBefore(const ResultJob& job);

/// Which pictures are to be made.
DrawingNeeds needsOf(const std::vector<PictureFile>& pictures);

/// Computes what the files want. Errors: those of Session::cells, pictureOf and draw.
Result<ResultParts> partsOf(Session& session, const ResultJob& job, const Sites& sites);

/// A writer for each file of ResultTargets::paths(); they refer to both.
std::vector<Writer> writersOf(const ResultJob& job, const ResultParts& parts);

/// The rows of --trace; without `with_times` what every run has alike.
std::string traceText(const std::vector<RelaxStep>& trace, bool with_times);

}  // namespace vorpipe::cli
