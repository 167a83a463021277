/// The sites of a run, and what follows from them where the options leave it open.
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
  std::optional<std::uint64_t> seed;    ///< of the generator; none for files
  std::vector<Attribute> attributes{};  ///< of a file's sites
  double read_ms = 0;
};

/// Loads or generates the sites of --sites, their weights and the domain. Errors: those of loadSites,
/// readWeights, readOutline and findDomain, after the option's name.
Result<Input> loadInput(const InputOptions& options);

/// The same for sites that stay where they are: `corners` are sites with the same box, and stand for them.
Result<Input> inputAround(const InputOptions& options, Sites corners);

/// Reads --density, which may be left out, with the place that --density-box names. Errors: those of
/// readDensity.
Result<DensityFile> densityOf(const DensityOptions& options);

/// Looks at where the density lies beside the input's domain. Errors: those of placeDensity.
Result<void> placeUnder(const DensityFile& density, const DensityOptions& from, const InputOptions& options,
                        Input& input);

/// The error of what an option names, with the option in front where the input is wrong.
tl::unexpected<Error> named(std::string_view option, Error error);

/// An error of the library, which begins with what is wrong, in the words of the command line, which begin
/// with the option that sets it.
tl::unexpected<Error> asOption(Error error, const InputOptions& options);

/// Refuses what checkInput does, in the words of the command line.
Result<void> checkInput(const InputOptions& options, const Input& input, const CellsOptions& cells,
                        int threads);

}  // namespace vorpipe::cli
