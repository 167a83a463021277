/// Points in well-known text.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/base/wkt_tokens.h"

namespace vorpipe {

struct WktPoints {
  std::vector<Point> points;             ///< none if it is EMPTY
  bool others = false;                   ///< whether positions have more than x and y
  std::optional<std::int64_t> system{};  ///< the code before it
};

/// Takes one POINT or MULTIPOINT.
WktProblem takePoints(WktTokens& tokens, WktPoints& taken);

}  // namespace vorpipe
