/// Numbers of twice double's precision: sums of a double and what rounding took from it
/// (Dekker 1971, "A floating-point technique for extending the available precision").
#pragma once

#include <cmath>

namespace vorpipe {

struct Wide {
  double high, low;

  /// The exact sum of two doubles.
  static Wide sum(double a, double b) {
    const double s = a + b;
    const double of_b = s - a;
    return {s, (a - (s - of_b)) + (b - of_b)};
  }
  /// The exact product of two doubles, but for underflow.
  static Wide product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
  }
  Wide operator-() const { return {-high, -low}; }
};

inline Wide operator+(Wide a, Wide b) {
  const Wide s = Wide::sum(a.high, b.high);
  return Wide::sum(s.high, s.low + (a.low + b.low));
}

inline Wide operator-(Wide a, Wide b) { return a + -b; }

inline Wide operator*(Wide a, Wide b) {
  const Wide p = Wide::product(a.high, b.high);
  return Wide::sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

inline Wide operator/(Wide a, Wide b) {
  const double first = a.high / b.high;
  const Wide left = a - b * Wide{first, 0};
  const double second = left.high / b.high;
  const Wide rest = left - b * Wide{second, 0};
  return Wide::sum(first, second) + Wide{rest.high / b.high, 0};
}

}  // namespace vorpipe
