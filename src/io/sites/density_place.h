/// Where a density lies, and where its domain does.
#pragma once

#include <string>

#include "io/sites/density_file.h"
#include "io/sites/site_domain.h"
#include "vorpipe.h"

namespace vorpipe {

/// Looks at a density beside the domain that was found, and adds notes: that pixels without a place are
/// stretched, that those with one leave a part of the domain empty. `name` is the file's; empty: the caller's
/// own array. Errors (input), after the word for the density: its place is in another system than the sites,
/// or in one that --project leaves; nothing of the domain lies there.
Result<void> placeDensity(const DensityFile& density, const std::string& name, PlacedSites& placed,
                          const DomainWords& words = {});

}  // namespace vorpipe
