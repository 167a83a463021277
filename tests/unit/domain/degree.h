/// What tests of projections compute in.
#pragma once

#include <numbers>

namespace vorpipe::test {

/// In radians.
inline constexpr double degree = std::numbers::pi / 180;

}  // namespace vorpipe::test
