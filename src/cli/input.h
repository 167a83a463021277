/// The sites of a run, and what follows from them where the options leave it open.
#pragma once

#include "cli/options.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct Input {
  Sites sites;
  Box domain{0, 0, 1, 1};
  Outline outline{};  ///< the domain is its box
  Periodic periodic = Periodic::none;
  std::optional<std::uint64_t> seed;  ///< of the generator; none for files
  double read_ms = 0;
};

/// What one site takes at most while its cell is computed with that detail, by a mean cell.
std::uint64_t bytesPerSite(Detail detail);
/// The same while it is drawn, and what a check takes beside either.
inline constexpr std::uint64_t bytes_per_drawn_site = 250;
inline constexpr std::uint64_t bytes_per_checked_site = 80;
/// What remains of a site once its cell is there, with Detail::measures, and drawn.
inline constexpr std::uint64_t bytes_per_kept_site = 90;

/// Loads or generates the sites of --sites, for a run that takes so many bytes for each, their weights and
/// the domain. Errors: those of loadSites, readWeights and readOutline, after the option's name; there are
/// too many sites for this machine's memory, no default domain holds them, options contradict each other
/// (input).
Result<Input> loadInput(const InputOptions& options, std::uint64_t bytes_per_site);

/// The error of what an option names, with the option in front where that is to blame.
tl::unexpected<Error> named(std::string_view option, Error error);

/// An error of the library, which begins with what is wrong, in the words of the command line, which begin
/// with the option that sets it.
tl::unexpected<Error> asOption(Error error);

/// The box of at least one site, grown on every side by 5 % of its longer side, or by 0.5 where all
/// sites are equal; by more where so little would vanish beside the coordinates.
Box domainOfSites(const Sites& sites);

/// Pixels for a picture of `domain`: the longer side 1000, the other at least 1.
Size defaultSize(const Box& domain);

/// Refuses (input) a picture for which this machine has too little memory; `pictures` are held at once.
Result<void> forecastPicture(const Size& size, std::uint64_t pictures);

}  // namespace vorpipe::cli
