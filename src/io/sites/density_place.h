/// Relates the place of a density to the domain.
#pragma once

#include <string>

#include "io/sites/density_file.h"
#include "io/sites/site_domain.h"
#include "vorpipe.h"

namespace vorpipe {

/// Compares a density's place with the domain found, and adds notes: pixels without a place are stretched;
/// those with one leave part of the domain empty. `name` is the file's; empty: the caller's own array. Errors
/// (input), after the word for the density: its place is in another system than the sites, or in one that
/// --project leaves; no part of the domain lies there.
Result<void> placeDensity(const DensityFile& density, const std::string& name, PlacedSites& placed,
                          const DomainWords& words = {});

}  // namespace vorpipe
