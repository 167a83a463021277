#include "space/predicates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "space/broken_tie.h"
#include "space/exact_signs.h"
#include "space/relative.h"

namespace vorpipe::space {
namespace {

thread_local std::uint64_t exact_signs = 0;

/// A sum of products, and that of their magnitudes.
struct Sum {
  double value, size;
};

Sum operator+(const Sum& a, const Sum& b) { return {a.value + b.value, a.size + b.size}; }
Sum operator-(const Sum& a, const Sum& b) { return {a.value - b.value, a.size + b.size}; }
Sum operator*(double a, const Sum& b) { return {a * b.value, std::abs(a) * b.size}; }
Sum liftTimes(const Relative& a, const Sum& b) { return {a.lift * b.value, a.lift_size * b.size}; }

Sum minorOf(const Relative& a, const Relative& b) {
  const double left = a.x * b.y, right = a.y * b.x;
  return {left - right, std::abs(left) + std::abs(right)};
}

// Rounding. Let u = 2^-53. Coordinates of a relative place are rounded once each, so that the value of
// - a 2x2 minor has in each of its terms 4 factors (1 + e), |e| <= u: 2 coordinates, product, difference;
// - a 3x3 determinant has 8: its minor's 4, coordinate, product, 2 sums;
// - a lift has 5, with weights 6, which is no less than those of a wall's (relative.h);
// - the 4x4 determinant has 17: determinant's 8, lift's 6, product, 2 sums.
// So its error is at most ((1 + u)^n - 1) times the sum of the terms' magnitudes, of which the computed one
// is at least (1 - u)^n: n u (1 + 2 n u) in all, and the last product with that factor is less than u off.
constexpr double orientation_rounding = 1e-15;  // 9.007 u, n = 8
constexpr double side_rounding = 2e-15;         // 18.01 u, n = 17

// Underflow. A product that is less than 2^-1022 is moreover off by at most h = 2^-1075. Let no coordinate be
// larger than C. A minor is off by 2 h, each term of a 3x3 determinant by 2 C h + h, so that by (6 C + 3) h.
constexpr double orientation_underflow = 0x1p-1070;  // times 1 + C: 32 h
// A lift is off by 3 h; let Q be the sum of all four lifts' sizes. C^2 <= Q if C > 1, because it belongs to a
// site. In each of four terms: (6 C + 3) h Q + 6 C^3 3 h + h <= 28 (1 + Q)^2 h.
constexpr double side_underflow = 0x1p-1066;  // times (1 + Q)^2: 512 h

/// The sign of a sum whose error is at most that; 0 if unknown. Sums that overflow are unknown, too.
int signIfProved(const Sum& sum, double error) { return sum.value > error ? 1 : sum.value < -error ? -1 : 0; }

/// Whether all numbers that a label stands for are multiples of one unit, and small ones, and those relative
/// to site i are at most 512 units. Then doubles hold all of cuts() exactly, because 72 512^5 < 2^53. So it
/// is in lattices, where ties are everywhere.
bool areFewUnits(const Places& places, Label i, const std::array<Label, 4>& other,
                 const std::array<Relative, 4>& seen) {
  double largest = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Relative& r = seen[k];
    const double far = std::max({std::abs(r.x), std::abs(r.y), std::abs(r.z)});
    largest = std::max(largest, isWallLabel(other[k]) ? std::abs(r.lift) : far);
  }
  constexpr std::uint64_t exponent = 0x7ffULL << 52U;
  const double unit = 0x1p-8 * std::bit_cast<double>(std::bit_cast<std::uint64_t>(largest) & exponent);
  const double all_digits = 0x1.8p52 * unit,
               limit = 0x1p50 * unit;  // that added, no digits below a unit are left
  bool few = true;
  const auto check = [&](double number) {
    few = few && std::abs(number) < limit && (number + all_digits) - all_digits == number;
  };
  const auto checkSite = [&](Label site) {
    check(places.sites[site].x);
    check(places.sites[site].y);
    check(places.sites[site].z);
  };
  checkSite(i);
  for (const Label label : other) {
    if (isWallLabel(label)) {
      check(wallOffset(places, label));
    } else {
      checkSite(label);
    }
  }
  return few;
}

}  // namespace

int orientation(const Places& places, Label i, Label j, Label k, Label l) {
  const Relative a = relative(places, i, j), b = relative(places, i, k), c = relative(places, i, l);
  const Sum sum = (a.z * minorOf(b, c) - b.z * minorOf(a, c)) + c.z * minorOf(a, b);
  const double far = 1 + a.size() + b.size() + c.size();
  const int sign = signIfProved(sum, orientation_rounding * sum.size + orientation_underflow * far);
  if (sign != 0) return sign;
  ++exact_signs;
  return exactOrientation(places, i, {j, k, l});
}

bool cuts(const Places& places, Label i, Label j, Label k, Label l, Label m) {
  const std::array<Label, 4> other{j, k, l, m};
  const std::array<Relative, 4> seen{relative(places, i, j), relative(places, i, k), relative(places, i, l),
                                     relative(places, i, m)};
  const auto& [a, b, c, d] = seen;
  const Sum ab = minorOf(a, b), ac = minorOf(a, c), ad = minorOf(a, d);
  const Sum bc = minorOf(b, c), bd = minorOf(b, d), cd = minorOf(c, d);
  const Sum abc = (a.z * bc - b.z * ac) + c.z * ab, abd = (a.z * bd - b.z * ad) + d.z * ab;
  const Sum acd = (a.z * cd - c.z * ad) + d.z * ac, bcd = (b.z * cd - c.z * bd) + d.z * bc;
  const Sum side = (liftTimes(d, abc) - liftTimes(c, abd)) + (liftTimes(b, acd) - liftTimes(a, bcd));
  const double far = 1 + (a.lift_size + b.lift_size) + (c.lift_size + d.lift_size);
  const int turn = signIfProved(abc, orientation_rounding * abc.size + orientation_underflow * far);
  const int sign = signIfProved(side, side_rounding * side.size + side_underflow * far * far);
  if (turn != 0 && sign != 0) return turn != sign;
  ++exact_signs;
  if (side.value == 0 && turn != 0 && places.weights == nullptr && areFewUnits(places, i, other, seen)) {
    return brokenTie(places, i, other, std::array{-bcd.value, acd.value, -abd.value, abc.value}) != turn;
  }
  return exactSide(places, i, other) != 1;
}

std::uint64_t exactSigns() { return exact_signs; }

}  // namespace vorpipe::space
