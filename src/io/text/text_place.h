/// Where something stands in a text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vorpipe {

/// "LINE:COLUMN" of a byte, both from 1.
std::string placeOf(std::string_view text, std::size_t byte);

}  // namespace vorpipe
