/// Masses of sites, apart from the sites or among their attributes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/attributes/attribute.h"
#include "vorpipe.h"

namespace vorpipe {

/// Reads the masses of `count` sites as readSiteNumbers does: each more than 0. A first line that begins with
/// a letter, as a column's name does, is no number.
Result<std::vector<double>> readMasses(const std::string& path, std::uint64_t count);

/// The same of the attribute with this name. Errors (input): there is none, or several; a value is missing,
/// or no mass.
Result<std::vector<double>> massesIn(std::span<const Attribute> attributes, std::string_view name);

}  // namespace vorpipe
