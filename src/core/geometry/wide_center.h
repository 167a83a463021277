/// Where three cells meet, in double-double.
#pragma once

#include <bit>
#include <cstdint>

#include "base/wide.h"
#include "core/geometry/vertex_position.h"

namespace vorpipe::core {

/// A power of two, as a double, by its biased exponent, 1 to 2046.
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
  const auto times = [](Wide a, double power) { return Wide{a.high * power, a.low * power}; };
  const auto difference = [&](double a, double b) { return times(Wide::sum(a, -b), down); };
  const Wide bx = difference(j.x, i.x), by = difference(j.y, i.y);
  const Wide cx = difference(k.x, i.x), cy = difference(k.y, i.y);
  const Wide area = bx * cy - by * cx;
  const Wide twice = area + area;
  const Wide bb = bx * bx + by * by + times(difference(i.weight, j.weight), down);
  const Wide cc = cx * cx + cy * cy + times(difference(i.weight, k.weight), down);
  const Wide rest_x = (cy * bb - by * cc) / twice;
  const Wide rest_y = (bx * cc - cx * bb) / twice;
  const Wide x = Wide{i.x, 0} + times(rest_x, up), y = Wide{i.y, 0} + times(rest_y, up);
  return {{x.high, y.high}, {x.low, y.low}};
}

}  // namespace vorpipe::core
