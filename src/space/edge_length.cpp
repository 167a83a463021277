#include "space/edge_length.h"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <optional>

#include "base/double_double.h"
#include "space/relative.h"

namespace vorpipe::space {
namespace {

using boost::multiprecision::cpp_bin_float;
using LongFloat = boost::multiprecision::number<cpp_bin_float<2000, boost::multiprecision::digit_base_2>,
                                                boost::multiprecision::et_off>;

/// The difference of two doubles, exactly.
template <class T>
T exactDifference(double a, double b) {
  return T(a) - T(b);
}
template <>
DoubleDouble exactDifference(double a, double b) {
  return DoubleDouble::sum(a, -b);
}

/// A face seen from a site as in Relative, with errors of T alone.
template <class T>
struct ExactRelative {
  T x, y, z, lift;
  double size, lift_size;  ///< magnitudes of the place, and of the terms of lift

  ExactRelative(const Places& places, Label site, Label other) {
    const Point3& from = places.sites[site];
    const Relative near = relative(places, site, other);
    size = near.size();
    lift_size = near.lift_size;
    if (isWallLabel(other)) {
      x = T(near.x);
      y = T(near.y);
      z = T(near.z);
      const int axis = axisOf(wallOf(other));
      const T outward = exactDifference<T>(wallOffset(places, other), coordinate(from, axis));
      lift = isUpper(wallOf(other)) ? outward + outward : -(outward + outward);
      return;
    }
    const Point3& to = places.sites[other];
    x = exactDifference<T>(to.x, from.x);
    y = exactDifference<T>(to.y, from.y);
    z = exactDifference<T>(to.z, from.z);
    lift = x * x + y * y + z * z;
    if (places.weights != nullptr)
      lift = lift + exactDifference<T>(places.weights[site], places.weights[other]);
  }
};

template <class T>
T determinant(const ExactRelative<T>& a, const ExactRelative<T>& b, const ExactRelative<T>& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

/// The vertices lie at p and p + s t, t = j x k; where the ways to l and m are unequal to 0 along t,
/// s = D / (2 (t.l) (t.m)), D the determinant of rows (x, y, z, lift). Nothing if the error may be more than
/// a millionth of the length, or of `fine`. `rounding` bounds the relative error of T's sums and products.
template <class T>
std::optional<double> lengthIn(const Places& places, Label i, const Label (&faces)[4], double fine,
                               double rounding) {
  const ExactRelative<T> j(places, i, faces[0]), k(places, i, faces[1]), l(places, i, faces[2]),
      m(places, i, faces[3]);
  const T jkl = determinant(j, k, l), jkm = determinant(j, k, m);
  const T klm = determinant(k, l, m), jlm = determinant(j, l, m);
  const double whole = static_cast<double>(jkl * m.lift - jkm * l.lift + jlm * k.lift - klm * j.lift);
  const double x = static_cast<double>(j.y * k.z - j.z * k.y), y = static_cast<double>(j.z * k.x - j.x * k.z),
               z = static_cast<double>(j.x * k.y - j.y * k.x);
  const double at_l = std::abs(static_cast<double>(jkl)), at_m = std::abs(static_cast<double>(jkm));
  const double along = std::hypot(x, y, z) / (2 * at_l * at_m);
  // Twenty roundings at most, of terms that are no larger than these.
  const double jk = j.size * k.size;
  const double terms = jk * (l.size * m.lift_size + m.size * l.lift_size) +
                       l.size * m.size * (j.size * k.lift_size + k.size * j.lift_size);
  const double length = std::abs(whole) * along, error = 32 * rounding * terms * along;
  constexpr double millionth = 0x1p-20;
  const bool are_ends_known =
      32 * rounding * jk * l.size <= millionth * at_l && 32 * rounding * jk * m.size <= millionth * at_m;
  if (!are_ends_known || !(error <= millionth * std::max(length, fine))) return std::nullopt;
  return length;
}

}  // namespace

double edgeLength(const Places& places, Label i, Label j, Label k, Label l, Label m, double fine) {
  const Label faces[4] = {j, k, l, m};
  if (const auto length = lengthIn<DoubleDouble>(places, i, faces, fine, 0x1p-102)) return *length;
  return lengthIn<LongFloat>(places, i, faces, fine, 0x1p-900).value_or(0);
}

}  // namespace vorpipe::space
