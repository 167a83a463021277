#include "geometry/segment.h"

#include <cmath>

namespace vorpipe::core {
namespace {

/// Integrals over the segment of a disc of radius 1. x runs along the chord, from its middle; y runs away
/// from the center, from the chord.
struct Integrals {
  double one, y, xx, yy;
};

/// With a = half_angle and x = sin u, for -a <= u <= a, the height of a segment is cos u - cos a. The
/// integrals of its powers are sums of these terms.
Integrals closedIntegrals(double a) {
  const double sin2 = std::sin(2 * a), sin4 = std::sin(4 * a), cosine = std::cos(a);
  return {a - sin2 / 2, 0.75 * std::sin(a) + std::sin(3 * a) / 12 - a * cosine,
          (a - sin2 * 2 / 3 + sin4 / 12) / 4, 0.75 * a + a * std::cos(2 * a) / 2 - sin2 * 7 / 12 - sin4 / 48};
}

/// The same by Taylor's series of the sines and cosines, up to the power `last` of the angle: their first
/// powers, which would cancel, are left out. For angles up to 1.
Integrals seriesOfIntegrals(double a) {
  constexpr int last = 33;
  Integrals sum{0, 0, 0, 0};
  double term = a;                      // +-a^n / n!
  double two = 2, three = 3, four = 4;  // to the power n
  for (int n = 3; n <= last; n += 2) {
    term *= -a * a / ((n - 1) * n);
    two *= 4;
    three *= 9;
    four *= 16;
    sum.one -= term * two / 2;
    if (n >= 5) {
      sum.y += term * (9 + three - 12 * n) / 12;
      sum.xx += term * (four - 8 * two) / 48;
    }
    if (n >= 7) sum.yy += term * ((12 * n - 28) * two - four) / 48;
  }
  return sum;
}

}  // namespace

SegmentMeasures measureSegment(double radius, double half_angle) {
  const Integrals of = half_angle < 1 ? seriesOfIntegrals(half_angle) : closedIntegrals(half_angle);
  if (!(of.one > 0)) return {0, 0, 0, 0};
  const double height = of.y / of.one, squared = radius * radius, fourth = squared * squared;
  return {squared * of.one, radius * height, fourth * of.xx, fourth * (of.yy - of.y * height)};
}

}  // namespace vorpipe::core
