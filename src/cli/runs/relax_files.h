/// The files that `relax` writes of sites as they stand.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options/picture_options.h"
#include "cli/options/relax_outputs.h"
#include "cli/runs/drawing.h"
#include "cli/runs/input.h"
#include "cli/runs/run_end.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// What files are made with.
struct RelaxJob {
  const RelaxTargets& targets;
  const InputOptions& options;
  const PictureOptions& picture;
  const Input& input;
  const Density& density;  ///< for the masses of cells
  SearchOptions search;
  int threads;
};

/// Sites, with what the files want of them.
struct RelaxedParts {
  Sites plane;                     ///< as they stand in the domain
  PlacedSites placed{};            ///< as files have them: in degrees, where the input was
  std::optional<Diagram> cells{};  ///< likewise
  std::optional<Drawing> drawing{};
  RenderOptions render{};
};

/// Which pictures are to be made.
DrawingNeeds needsOf(const std::vector<PictureFile>& pictures);

/// Computes what the files want. Errors: those of Session::cells, pictureOf and draw.
Result<RelaxedParts> partsOf(Session& session, const RelaxJob& job, const Sites& sites);

/// A writer for each file of RelaxTargets::paths(); they refer to both.
std::vector<Writer> writersOf(const RelaxJob& job, const RelaxedParts& parts);

/// The rows of --trace; without `with_times` what every run has alike.
std::string traceText(const std::vector<RelaxStep>& trace, bool with_times);

}  // namespace vorpipe::cli
