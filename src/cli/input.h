/// The sites of a run, and what follows from them if the options do not set it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/density_options.h"
#include "cli/options/options.h"
#include "io/base/attribute.h"
#include "io/sites/density_file.h"
#include "io/sites/site_domain.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct Input : PlacedSites {
  std::optional<std::uint64_t> seed;      ///< the generator's; none for files
  std::vector<Attribute> attributes{};    ///< of a file's sites
  std::optional<Attribute> part_names{};  ///< of the outline's parts, with --by
  double read_ms = 0;
};

/// Loads or generates the sites of --sites, their weights and the domain. Errors: those of loadSites,
/// readWeights, readOutline and findDomain, after the option's name.
Result<Input> loadInput(const InputOptions& options);

/// Sets input.sites.weight, if options do, to those of `sites` sites. Error (input): they have some already.
Result<void> takeWeights(const InputOptions& options, std::size_t sites, Input& input);

/// The same as loadInput for sites that stay in place: `corners`, sites with the same bounding box, represent
/// them.
Result<Input> inputAround(const InputOptions& options, Sites corners);

/// Returns the options of the cells of an input.
CellsOptions cellsOptionsOf(const Input& input, const SearchOptions& search = {});

/// Returns the command line's names for the messages about a domain.
DomainWords domainWords(const InputOptions& options);

/// Reads --density, if given, at the place that --density-box names. Errors: those of readDensity.
Result<DensityFile> densityOf(const DensityOptions& options);

/// Checks the position of the density relative to the input's domain. Errors: those of placeDensity.
Result<void> placeUnder(const DensityFile& density, const DensityOptions& from, const InputOptions& options,
                        Input& input);

/// Returns the error of an option's value, with the option in front if the input is wrong.
tl::unexpected<Error> named(std::string_view option, Error error);

/// Translates an error of the library, which begins with the wrong value's name, to the command line: it then
/// begins with the option that sets the value.
tl::unexpected<Error> asOption(Error error, const InputOptions& options);

/// Same errors as the library's checkInput, in the words of the command line.
Result<void> checkInput(const InputOptions& options, const Input& input, const CellsOptions& cells,
                        int threads);

}  // namespace vorpipe::cli
