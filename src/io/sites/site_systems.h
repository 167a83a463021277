/// The coordinate systems of sites and an outline, made one.
#pragma once

#include <string>

#include "io/sites/site_domain.h"

namespace vorpipe {

/// Returns the outline's name for messages.
std::string nameOfOutline(const DomainSettings& settings);

/// Gives sites without a system the one that the settings name, else that of the outline, if their
/// coordinates may be of it. Adds notes: what was adopted, or taken for the same. Errors (input): sites and
/// outline are in different systems, or not in the one that the settings name.
Result<void> settleSystems(const DomainSettings& settings, PlacedSites& placed, const DomainWords& words);

}  // namespace vorpipe
