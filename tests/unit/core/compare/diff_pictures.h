/// Id images of one size for the tests of the diff.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::test {

constexpr int width = 160;
constexpr int height = 120;
constexpr Box unit{0, 0, 1, 1};

using Ids = std::vector<std::uint32_t>;

inline std::size_t at(int row, int column) { return static_cast<std::size_t>(row * width + column); }

}  // namespace vorpipe::test
