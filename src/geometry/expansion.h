/// Sums of doubles that hold a number exactly (Shewchuk 1997, "Adaptive precision floating-point arithmetic
/// and fast robust geometric predicates").
#pragma once

#include <array>
#include <cstddef>

#include "base/double_double.h"
#include "geometry/predicates.h"

namespace vorpipe::core {

/// A sum of doubles none of which overlap, ascending by magnitude, without zeros.
template <std::size_t most>
struct Expansion {
  std::array<double, most> part;
  std::size_t size = 0;

  void append(double value) {
    if (value != 0) part[size++] = value;
  }
  [[nodiscard]] int sign() const { return size == 0 ? 0 : (part[size - 1] > 0 ? 1 : -1); }
};

/// Adds a double to a sum that has room for it (Grow-Expansion).
template <std::size_t most>
void grow(Expansion<most>& sum, double value) {
  Expansion<most> grown;
  double carry = value;
  for (std::size_t k = 0; k < sum.size; ++k) {
    const DoubleDouble s = DoubleDouble::sum(carry, sum.part[k]);
    grown.append(s.low);
    carry = s.high;
  }
  grown.append(carry);
  sum.size = grown.size;
  for (std::size_t k = 0; k < grown.size; ++k) sum.part[k] = grown.part[k];
}

template <std::size_t a, std::size_t b>
Expansion<a + b> operator+(const Expansion<a>& x, const Expansion<b>& y) {
  Expansion<a + b> sum;
  for (std::size_t k = 0; k < x.size; ++k) sum.append(x.part[k]);
  for (std::size_t k = 0; k < y.size; ++k) grow(sum, y.part[k]);
  return sum;
}

template <std::size_t a>
Expansion<a> operator-(Expansion<a> x) {
  for (std::size_t k = 0; k < x.size; ++k) x.part[k] = -x.part[k];
  return x;
}

template <std::size_t a, std::size_t b>
Expansion<a + b> operator-(const Expansion<a>& x, const Expansion<b>& y) {
  return x + -y;
}

/// Scale-Expansion.
template <std::size_t a>
Expansion<2 * a> scaled(const Expansion<a>& x, double factor) {
  Expansion<2 * a> result;
  if (x.size == 0) return result;
  const DoubleDouble first = DoubleDouble::product(x.part[0], factor);
  result.append(first.low);
  double carry = first.high;
  for (std::size_t k = 1; k < x.size; ++k) {
    const DoubleDouble next = DoubleDouble::product(x.part[k], factor);
    const DoubleDouble s = DoubleDouble::sum(carry, next.low);
    result.append(s.low);
    const DoubleDouble t = DoubleDouble::sum(next.high, s.high);
    result.append(t.low);
    carry = t.high;
  }
  result.append(carry);
  return result;
}

template <std::size_t a, std::size_t b>
Expansion<2 * a * b> operator*(const Expansion<a>& x, const Expansion<b>& y) {
  Expansion<2 * a * b> result;
  for (std::size_t k = 0; k < y.size; ++k) {
    const auto part = scaled(x, y.part[k]);
    for (std::size_t p = 0; p < part.size; ++p) grow(result, part.part[p]);
  }
  return result;
}

inline Expansion<2> difference(double a, double b) {
  const DoubleDouble d = DoubleDouble::sum(a, -b);
  Expansion<2> result;
  result.append(d.low);
  result.append(d.high);
  return result;
}

/// A point relative to d, lifted to the paraboloid, with a weight, which moves it down by weight - d.weight.
struct LiftedByWeight {
  Expansion<2> x, y;
  Expansion<18> squared;  ///< x^2 + y^2 less that
  LiftedByWeight(const WeightedPoint& p, const WeightedPoint& d)
      : x(difference(p.x, d.x)),
        y(difference(p.y, d.y)),
        squared(x * x + y * y + difference(d.weight, p.weight)) {}
};

}  // namespace vorpipe::core
