/// The options of `fluid`: what to compute, and what to write.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/cells_outputs.h"
#include "cli/options/command_line.h"
#include "io/cells/points_file.h"
#include "view/flowing.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// The values that the options set; all others come from the case or the file.
struct FluidChoices {
  std::string begin;                       ///< a case, or a file
  std::string resume;                      ///< a file
  std::optional<std::uint64_t> particles;  ///< none: usualParcels() of the case
  FluidOptions options{};
  std::set<std::string_view> given;  ///< the names of those options that are given, by fluid_rows
  std::string domain, domain_layer;  ///< a file with an outline, and a layer of it
  bool repair = false;               ///< of the outline
  std::optional<std::uint64_t> steps;
  std::optional<double> seconds;
};

/// The output files of a fluid; empty paths: not requested.
struct FluidTargets {
  struct Points {
    std::string path;
    const PointsFormat* format;
  };
  std::vector<Points> points;
  std::vector<CellsTarget> cells;
  std::string checkpoint, trace;         ///< files written during the run
  std::string frames, series;            ///< a film or a folder; a folder
  std::optional<view::FlowColor> color;  ///< of frames
  std::uint64_t every = 10;              ///< steps between frames, files of the series and checkpoints

  /// Returns the paths of the files written at the end, in the order in which they are created.
  [[nodiscard]] std::vector<std::string> paths() const;
};

/// --case, --resume, --particles, --time, --step, --scheme, --epsilon, --viscosity, --walls, --gravity,
/// --tolerance; `usual_end` describes the end time if none is given
void addFluidStart(Options& options, FluidChoices& choices, std::string_view usual_end);

/// All of the above, --domain, --domain-layer, --repair, --steps and --seconds
void addFluidChoices(Options& options, FluidChoices& choices);

/// --flow-color
void addFlowColor(Options& options, std::optional<view::FlowColor>& color);

/// -o, --cells, --checkpoint, --trace, --frames, --series, --every
void addFluidTargets(Options& options, FluidTargets& targets);

/// Replaces the options that are given.
void takeGiven(const FluidChoices& choices, FluidOptions& options);

/// Returns the fluid that the options name, which may run forever. Errors (input): the options contradict
/// each other; those of the file.
Result<FluidSetup> startOf(const FluidChoices& choices);
/// The same for a fluid that ends. Errors (input): also that it does not end.
Result<FluidSetup> setupOf(const FluidChoices& choices);

/// Translates an error of the library, which begins with the wrong value's name, to the command line: it then
/// names the given option, or else the fluid's file.
tl::unexpected<Error> asFluidOption(Error error, const FluidChoices& choices);

}  // namespace vorpipe::cli
