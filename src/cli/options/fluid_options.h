/// What `fluid` computes, and what it writes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/cells_outputs.h"
#include "cli/options/command_line.h"
#include "io/cells/points_file.h"
#include "view/flowing.h"
#include "vorpipe/fluid.h"

namespace vorpipe::cli {

/// What the options name; what they do not is as the case or the file has it.
struct FluidChoices {
  std::string begin;   ///< a case, or a file
  std::string resume;  ///< a file
  std::uint64_t particles = 2048;
  bool particles_named = false;
  std::optional<double> until, step, epsilon, tolerance;
  std::optional<Point> gravity;
  std::optional<FluidScheme> scheme;
  std::optional<std::uint64_t> steps;
  std::optional<double> seconds;
};

/// The files of a fluid; empty paths are not asked for.
struct FluidTargets {
  struct Points {
    std::string path;
    const PointsFormat* format;
  };
  std::vector<Points> points;
  std::vector<CellsTarget> cells;
  std::string stats;                     ///< a file at the end
  std::string checkpoint, trace;         ///< files on the way
  std::string frames, series;            ///< a film or a folder; a folder
  std::optional<view::FlowColor> color;  ///< of frames
  std::uint64_t every = 10;              ///< steps between frames, files of the series and checkpoints

  /// Of the files at the end, in the order in which they are created.
  [[nodiscard]] std::vector<std::string> paths() const;
};

/// --case, --resume, --particles, --time, --step, --scheme, --epsilon, --gravity, --tolerance; `usual_end` is
/// the time at which it ends where none is named
void addFluidStart(Options& options, FluidChoices& choices, std::string_view usual_end);

/// All of these, --steps and --seconds
void addFluidChoices(Options& options, FluidChoices& choices);

/// --flow-color
void addFlowColor(Options& options, std::optional<view::FlowColor>& color);

/// -o, --cells, --checkpoint, --trace, --frames, --series, --every
void addFluidTargets(Options& options, FluidTargets& targets);

/// The fluid that the options name, which may go on forever. Errors (input): they contradict each other; the
/// file's.
Result<FluidSetup> startOf(const FluidChoices& choices);
/// The same of one that ends. Errors (input): that it does not.
Result<FluidSetup> setupOf(const FluidChoices& choices);

/// An error of the library, which begins with what is wrong, in the words of the command line: the option
/// that was given, or else the file that the fluid is of.
tl::unexpected<Error> asFluidOption(Error error, const FluidChoices& choices);

/// "springs" or "projection".
std::string_view nameOf(FluidScheme scheme);

}  // namespace vorpipe::cli
