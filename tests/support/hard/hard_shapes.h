/// Places that are hard on arithmetic, in or about the unit square.
#pragma once

#include <span>
#include <string_view>

#include "support/hard/hard_random.h"

namespace vorpipe::test {

struct HardShape {
  std::string_view name;
  /// About n sites.
  Sites (*make)(std::uint64_t n, Random& random);
};

std::span<const HardShape> hardShapes();

}  // namespace vorpipe::test
