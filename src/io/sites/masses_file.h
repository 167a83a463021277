/// Masses of sites, apart from the sites or among their attributes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "vorpipe.h"

namespace vorpipe {

/// Whether a mass may be 0, which no cell has.
enum class ZeroMass : std::uint8_t { refused, taken };

/// What is wrong with a text that is to be a mass.
tl::expected<void, std::string> checkMass(std::string_view text, ZeroMass zero = ZeroMass::refused);

/// Reads the masses of `count` sites as readSiteNumbers does: each more than 0, or 0 where that is taken. A
/// first line that begins with a letter, as a column's name does, is no number.
Result<std::vector<double>> readMasses(const std::string& path, std::uint64_t count,
                                       ZeroMass zero = ZeroMass::refused);

/// The same of the attribute with this name. Errors (input): there is none, or several; a value is missing,
/// or no mass.
Result<std::vector<double>> massesIn(std::span<const Attribute> attributes, std::string_view name,
                                     ZeroMass zero = ZeroMass::refused);

}  // namespace vorpipe
