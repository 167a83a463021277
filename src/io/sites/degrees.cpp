#include "io/sites/degrees.h"

#include <algorithm>

namespace vorpipe {

bool looksLikeDegrees(const Sites& sites, const CoordinateSystem& system) {
  constexpr double half_turn = 180, quarter = 90;
  if (system.kind != CoordinateKind::unknown) return system.kind == CoordinateKind::degrees;
  if (sites.size() == 0) return false;
  const auto [west, east] = std::ranges::minmax(sites.x);
  const auto [south, north] = std::ranges::minmax(sites.y);
  return west >= -half_turn && west < -quarter && east > quarter && east <= half_turn && south >= -quarter &&
         north <= quarter;
}

}  // namespace vorpipe
