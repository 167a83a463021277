/// Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric predicates": first
/// in double with a bound of the error, and where that does not tell, exactly, as sums of doubles.
#include "core/predicates.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "core/wide.h"

namespace vorpipe {
namespace {

constexpr double orientation_error = 3.3306690738754716e-16;
constexpr double in_circle_error = 1.1102230246251577e-15;

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
    const Wide s = Wide::sum(carry, sum.part[k]);
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
  const Wide first = Wide::product(x.part[0], factor);
  result.append(first.low);
  double carry = first.high;
  for (std::size_t k = 1; k < x.size; ++k) {
    const Wide next = Wide::product(x.part[k], factor);
    const Wide s = Wide::sum(carry, next.low);
    result.append(s.low);
    const Wide t = Wide::sum(next.high, s.high);
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

Expansion<2> difference(double a, double b) {
  const Wide d = Wide::sum(a, -b);
  Expansion<2> result;
  result.append(d.low);
  result.append(d.high);
  return result;
}

int exactOrientation(Point a, Point b, Point c) {
  const auto left = difference(a.x, c.x) * difference(b.y, c.y);
  const auto right = difference(a.y, c.y) * difference(b.x, c.x);
  return (left - right).sign();
}

/// A point from d: the ways along x and y, and the square of its distance.
struct Lifted {
  Expansion<2> x, y;
  Expansion<16> squared;
  Lifted(Point p, Point d) : x(difference(p.x, d.x)), y(difference(p.y, d.y)), squared(x * x + y * y) {}
};

int exactInCircle(Point a, Point b, Point c, Point d) {
  const Lifted p(a, d), q(b, d), r(c, d);
  const auto minor = [](const Lifted& s, const Lifted& t) { return s.x * t.y - s.y * t.x; };
  return (p.squared * minor(q, r) + q.squared * minor(r, p) + r.squared * minor(p, q)).sign();
}

}  // namespace

int orientation(Point a, Point b, Point c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double area = left - right;
  const double error = orientation_error * (std::abs(left) + std::abs(right));
  if (std::abs(area) > error) return area > 0 ? 1 : -1;
  return exactOrientation(a, b, c);
}

int inCircle(Point a, Point b, Point c, Point d) {
  const double ax = a.x - d.x, ay = a.y - d.y;
  const double bx = b.x - d.x, by = b.y - d.y;
  const double cx = c.x - d.x, cy = c.y - d.y;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const double inside = aa * (bx * cy - by * cx) + bb * (cx * ay - cy * ax) + cc * (ax * by - ay * bx);
  const double size = aa * (std::abs(bx * cy) + std::abs(by * cx)) +
                      bb * (std::abs(cx * ay) + std::abs(cy * ax)) +
                      cc * (std::abs(ax * by) + std::abs(ay * bx));
  if (std::abs(inside) > in_circle_error * size) return inside > 0 ? 1 : -1;
  return exactInCircle(a, b, c, d);
}

}  // namespace vorpipe
