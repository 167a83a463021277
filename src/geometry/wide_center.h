/// Where three cells meet, in double-double.
#pragma once

#include <bit>
#include <cstdint>

#include "base/double_double.h"
#include "geometry/anchored_point.h"
#include "geometry/predicates.h"

namespace vorpipe::core {

/// Returns the power of two with this biased exponent, 1 to 2046.
inline double powerOfBiased(std::int64_t biased) { return std::bit_cast<double>(biased << 52); }

/// The power center of i, j and k; i lies opposite the longest side. Free of branches, so that loops over
/// triples are vectorized.
[[gnu::always_inline]] inline AnchoredPoint wideCenterOf(const WeightedPoint& i, const WeightedPoint& j,
                                                         const WeightedPoint& k) {
  constexpr std::int64_t bias = 1023, most = 2 * bias - 2;
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  const auto magnitude = [](double a) { return a < 0 ? -a : a; };
  const double longest = larger(larger(magnitude(j.x - i.x), magnitude(j.y - i.y)),
                                larger(magnitude(k.x - i.x), magnitude(k.y - i.y)));
  // Scaled to lengths of about 1, no square or product overflows or underflows.
  const auto biased = std::bit_cast<std::int64_t>(longest) >> 52;
  const auto exponent = biased < most ? biased : most;
  const double down = powerOfBiased(2 * bias - exponent), up = powerOfBiased(exponent);
  const auto times = [](DoubleDouble a, double power) { return DoubleDouble{a.high * power, a.low * power}; };
  const auto difference = [&](double a, double b) { return times(DoubleDouble::sum(a, -b), down); };
  const DoubleDouble bx = difference(j.x, i.x), by = difference(j.y, i.y);
  const DoubleDouble cx = difference(k.x, i.x), cy = difference(k.y, i.y);
  const DoubleDouble area = bx * cy - by * cx;
  const DoubleDouble twice = area + area;
  const DoubleDouble bb = bx * bx + by * by + times(difference(i.weight, j.weight), down);
  const DoubleDouble cc = cx * cx + cy * cy + times(difference(i.weight, k.weight), down);
  const DoubleDouble rest_x = (cy * bb - by * cc) / twice;
  const DoubleDouble rest_y = (bx * cc - cx * bb) / twice;
  const DoubleDouble x = DoubleDouble(i.x) + times(rest_x, up), y = DoubleDouble(i.y) + times(rest_y, up);
  return {{x.high, y.high}, {x.low, y.low}};
}

}  // namespace vorpipe::core
