/// How much memory a run takes, told before it begins.
#pragma once

#include <cstdint>
#include <optional>

#include "cli/input.h"
#include "cli/parse.h"
#include "vorpipe.h"

namespace vorpipe::cli {

/// What remains of a site once it is drawn and its cell is there with Detail::measures, and what a check
/// takes for each beside what it checks.
inline constexpr std::uint64_t bytes_per_kept_site = 90, bytes_per_checked_site = 80;

/// Refuses (input) sites for which this machine has too little memory; `weighted` says whether they have
/// weights, whatever options say.
Result<void> forecastSites(const Work& work, const InputOptions& options, std::uint64_t sites, bool weighted);

/// The same for the images of a periodic domain. Errors: also those of sitesAndImages.
Result<void> forecastImages(const Work& work, const Input& input, int threads);

/// Refuses (input) a picture for which this machine has too little memory; `pictures` are held at once.
Result<void> forecastPicture(const Size& size, std::uint64_t pictures);

}  // namespace vorpipe::cli
