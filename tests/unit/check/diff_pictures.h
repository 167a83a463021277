/// Id images of one size for the tests of the diff.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/sites/unit.h"
#include "vorpipe.h"

namespace vorpipe::test {

constexpr int picture_width = 160;
constexpr int picture_height = 120;
using Ids = std::vector<std::uint32_t>;

inline std::size_t at(int row, int column) { return static_cast<std::size_t>(row * picture_width + column); }

}  // namespace vorpipe::test
