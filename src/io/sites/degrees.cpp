#include "io/sites/degrees.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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

std::string hintAcrossAntimeridian(double west, double east) {
  constexpr double half_turn = 180, whole_turn = 360;
  if (!(west > 0 && west <= half_turn && east < 0 && east >= -half_turn)) return {};
  return fmt::format("; in degrees, across the antimeridian, xmax is {}", east + whole_turn);
}

std::string_view settleDegrees(const Sites& sites, CoordinateSystem& system) {
  constexpr double most_x = 360, most_y = 90;
  if (system.kind != CoordinateKind::degrees) return {};
  const auto within = [](double most) { return [most](double value) { return std::abs(value) <= most; }; };
  if (std::ranges::all_of(sites.x, within(most_x)) && std::ranges::all_of(sites.y, within(most_y))) return {};
  system = {};
  return "should hold degrees of longitude and latitude, and reaches beyond 360 or 90: it is taken as a "
         "plane";
}

}  // namespace vorpipe
