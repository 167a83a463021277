/// The domain of most tests.
#pragma once

#include "vorpipe.h"

namespace vorpipe::test {

inline constexpr Box unit{0, 0, 1, 1};

}  // namespace vorpipe::test
