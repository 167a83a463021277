/// Numbers of about 104 bits: the unevaluated sum of two doubles, the second below the rounding of the first
/// (Dekker 1971, "A floating-point technique for extending the available precision"; Knuth 1969). Needs sums
/// and products that are rounded one by one: -ffp-contract=off.
#pragma once

#include <cmath>

namespace vorpipe {

struct DoubleDouble {
  double high = 0, low = 0;

  DoubleDouble() = default;
  explicit DoubleDouble(double value) : high(value) {}
  DoubleDouble(double larger, double smaller) : high(larger), low(smaller) {}
  explicit operator double() const { return high; }

  /// a + b, exactly.
  static DoubleDouble sum(double a, double b) {
    const double s = a + b;
    const double of_b = s - a;
    return {s, (a - (s - of_b)) + (b - of_b)};
  }

  /// a + b, exactly, if |a| >= |b|.
  static DoubleDouble sorted(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }

  /// a b, exactly, except for underflow.
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
  }

  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const auto s = sum(a.high, b.high);
    const auto t = sum(a.low, b.low);
    const auto r = sorted(s.high, s.low + t.high);
    return sorted(r.high, r.low + t.low);
  }

  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }

  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const auto p = product(a.high, b.high);
    return sorted(p.high, p.low + (a.high * b.low + a.low * b.high));
  }

  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    const auto rest = a - b * DoubleDouble(first);
    const double second = rest.high / b.high;
    const auto last = rest - b * DoubleDouble(second);
    const auto q = sorted(first, second);
    return q + DoubleDouble(last.high / b.high);
  }

  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) { return a < b || a == b; }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }
  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high == b.high && a.low == b.low;
  }
};

inline DoubleDouble abs(const DoubleDouble& a) { return a.high < 0 ? -a : a; }

inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (!(a.high > 0)) return DoubleDouble(0);
  const double root = std::sqrt(a.high);
  const auto rest = a - DoubleDouble::product(root, root);
  return DoubleDouble::sorted(root, rest.high / (2 * root));
}

}  // namespace vorpipe
