/// Whether there is memory for what a file claims to hold, before it is taken.
#pragma once

#include <cstdint>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe {

/// Error (input): `bytes` are more than this process may take; "NAME: its WHAT need about ...".
Result<void> checkRoom(std::string_view name, std::string_view what, std::uint64_t bytes);

}  // namespace vorpipe
