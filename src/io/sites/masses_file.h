/// Masses of sites, from a separate file or from attributes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/attribute.h"
#include "vorpipe.h"

namespace vorpipe {

/// Whether a mass may be 0; no cell has mass 0.
enum class ZeroMass : std::uint8_t { refused, taken };

/// Checks that a text is a mass. The error states what is wrong with it.
tl::expected<void, std::string> checkMass(std::string_view text, ZeroMass zero = ZeroMass::refused);

/// Reads the masses of `count` sites as readSiteNumbers does: each more than 0, or 0 if allowed. Skips a
/// first line that begins with a letter, as a column's name does.
Result<std::vector<double>> readMasses(const std::string& path, std::uint64_t count,
                                       ZeroMass zero = ZeroMass::refused);

/// The same from the attribute with this name. Errors (input): there is none, or several; a value is missing,
/// or no mass.
Result<std::vector<double>> massesIn(std::span<const Attribute> attributes, std::string_view name,
                                     ZeroMass zero = ZeroMass::refused);

}  // namespace vorpipe
