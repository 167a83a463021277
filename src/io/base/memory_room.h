/// Checks, before allocation, whether there is memory for what a file claims to hold.
#pragma once

#include <cstdint>
#include <string_view>

#include "vorpipe.h"

namespace vorpipe {

/// Error (input): `bytes` is more than this process may allocate; "NAME: its WHAT need about ...".
Result<void> checkRoom(std::string_view name, std::string_view what, std::uint64_t bytes);

}  // namespace vorpipe
