/// Where three cells meet: fast, and in double-double.
#pragma once

#include <bit>
#include <cstdint>

#include "base/double_double.h"
#include "geometry/vertex_position.h"

namespace vorpipe::core {

struct PowerCenter {
  double base_x, base_y, rest_x, rest_y;  ///< as AnchoredPoint
  double sure;                            ///< 1: precise; 0: wideCenterOf must find it
};

/// Terms of a position may be up to 16 times as large as the lengths it is compared with: 4 bits are lost.
inline constexpr double most_terms = 16;

/// The power center (radical center) of three points i, p, j: the point whose powers to all three are equal.
/// Without weights that is their circumcenter, and iw, pw and jw are not read.
///
/// Differences are taken to the point opposite the longest side: of two points side by side and one far away,
/// they stay exact. Unsure if that point is not unique, or if cancellation, underflow or a far center costs
/// precision. The result is the same to the bit for any order of the points: swapping b and c changes the
/// signs of the numerators and of the denominator.
///
/// Selections are products with 0 and 1, which are exact and free of branches, so that loops over triples
/// are vectorized.
template <bool weighted>
inline PowerCenter powerCenter(double ix, double iy, double iw, double px, double py, double pw, double jx,
                               double jy, double jw) {
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  const auto magnitude = [](double a) { return a < 0 ? -a : a; };
  const double ip_x = px - ix, ip_y = py - iy;
  const double ij_x = jx - ix, ij_y = jy - iy;
  const double pj_x = jx - px, pj_y = jy - py;
  const double ip = ip_x * ip_x + ip_y * ip_y;
  const double ij = ij_x * ij_x + ij_y * ij_y;
  const double pj = pj_x * pj_x + pj_y * pj_y;
  const double at_i = pj > larger(ip, ij) ? 1 : 0;
  const double at_p = ij > larger(ip, pj) ? 1 : 0;
  const double at_j = ip > larger(ij, pj) ? 1 : 0;
  const double b_x = (at_i - at_p) * ip_x - at_j * pj_x;
  const double b_y = (at_i - at_p) * ip_y - at_j * pj_y;
  const double c_x = (at_i - at_j) * ij_x + at_p * pj_x;
  const double c_y = (at_i - at_j) * ij_y + at_p * pj_y;
  double bb = (at_i + at_p) * ip + at_j * pj;
  double cc = (at_i + at_j) * ij + at_p * pj;
  double b_size = bb, c_size = cc;
  if constexpr (weighted) {
    const double b_weight = (at_i - at_p) * (iw - pw) + at_j * (jw - pw);
    const double c_weight = (at_i - at_j) * (iw - jw) + at_p * (pw - jw);
    bb += b_weight;
    cc += c_weight;
    b_size += magnitude(b_weight);
    c_size += magnitude(c_weight);
  }
  const double left = b_x * c_y;
  const double right = b_y * c_x;
  const double half = 0.5 / (left - right);
  const double rest_x = (c_y * bb - b_y * cc) * half;
  const double rest_y = (b_x * cc - c_x * bb) * half;
  const double size = magnitude(left) + magnitude(right);
  const double twice_area = magnitude(left - right);
  // Each of these comparisons is false for NaN.
  double exact = 8 * twice_area > larger(size, 1e-139) ? 1 : 0;
  const double near = rest_x * rest_x + rest_y * rest_y < 64 ? 1 : 0;
  if constexpr (weighted) {
    // If three points are nearly on a line, or one is far away, the center can be near only with weights: the
    // numerators cancel.
    const double b_length = magnitude(b_x) + magnitude(b_y), c_length = magnitude(c_x) + magnitude(c_y);
    const double shortest = b_length < c_length ? b_length : c_length;
    const double length = shortest + magnitude(rest_x) + magnitude(rest_y);
    const double terms = (b_length * c_size + c_length * b_size) * magnitude(half);
    constexpr double farthest = 8;
    exact *= terms < most_terms * (length < farthest ? length : farthest) ? 1 : 0;
  }
  return {at_i * ix + at_p * px + at_j * jx, at_i * iy + at_p * py + at_j * jy, rest_x, rest_y,
          (at_i + at_p + at_j) * exact * near};
}

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
