/// The sites of a run, and what follows from them where the options leave it open.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"
#include "io/attributes/attribute.h"
#include "io/attributes/coordinate_system.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct Input {
  Sites sites;
  Box domain{0, 0, 1, 1};
  Outline outline{};  ///< the domain is its box
  Periodic periodic = Periodic::none;
  std::optional<std::uint64_t> seed;    ///< of the generator; none for files
  std::vector<Attribute> attributes{};  ///< of a file's sites
  CoordinateSystem system{};
  std::vector<std::string> notes{};  ///< what was reinterpreted or left out of the input, a line each
  double read_ms = 0;
};

/// Loads or generates the sites of --sites, their weights and the domain. Errors: those of loadSites,
/// readWeights and readOutline, after the option's name; no default domain holds them, options contradict
/// each other (input).
Result<Input> loadInput(const InputOptions& options);

/// Prints the input's notes on standard error, unless quiet: once the input is known to have no errors.
void printNotes(const TalkOptions& talk, const Input& input);

/// The error of what an option names, with the option in front where the input is wrong.
tl::unexpected<Error> named(std::string_view option, Error error);

/// An error of the library, which begins with what is wrong, in the words of the command line, which begin
/// with the option that sets it.
tl::unexpected<Error> asOption(Error error, const InputOptions& options);

/// Refuses what checkInput does, in the words of the command line.
Result<void> checkInput(const InputOptions& options, const Input& input, const CellsOptions& cells,
                        int threads);

}  // namespace vorpipe::cli
