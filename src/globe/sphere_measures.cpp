#include "globe/sphere_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vorpipe::core {
namespace {

constexpr double pi = std::numbers::pi;

// WGS 84.
constexpr double equator_radius = 6378.137;  // km
constexpr double flattening = 1 / 298.257223563, ellipticity = flattening * (2 - flattening);

constexpr std::size_t terms = 8;

/// The factors of (sin^2 latitude)^k in Snyder's q (3-12), by the sine: sine * (1 - e^2) * sum of
/// e^2k (2k + 2) / (2k + 1) (sin^2)^k.
constexpr std::array<double, terms> authalicSeries() {
  std::array<double, terms> factors{};
  double power = 1;
  for (std::size_t k = 0; k < terms; ++k) {
    factors[k] = power * static_cast<double>(2 * k + 2) / static_cast<double>(2 * k + 1);
    power *= ellipticity;
  }
  return factors;
}

constexpr double sumOf(const std::array<double, terms>& factors) {
  double sum = 0;
  for (const double factor : factors) sum += factor;
  return sum;
}

/// The sine of the authalic latitude is s + s (1 - s^2) g(s^2), where s is that of the geodetic one: these
/// are the factors of the polynomial g.
constexpr std::array<double, terms - 1> differenceSeries() {
  const auto series = authalicSeries();
  std::array<double, terms - 1> factors{};
  double rest = 0;
  for (std::size_t j = terms - 1; j-- > 0;) {
    rest += series[j + 1];
    factors[j] = -rest / sumOf(series);
  }
  return factors;
}

double squaredRadius() {
  return equator_radius * equator_radius * (1 - ellipticity) * sumOf(authalicSeries()) / 2;
}

/// What the ellipsoid has more than the sphere, at sine s, by z (x dy - y dx) along the border (Green).
double difference(double s) {
  constexpr auto factors = differenceSeries();
  const double squared = s * s;
  double sum = 0;
  for (std::size_t j = factors.size(); j-- > 0;) sum = sum * squared + factors[j];
  return -s * sum;
}

/// The angle whose sine and cosine are as y to x.
double angleOf(double y, double x) {
  constexpr double short_series = 0.01;
  if (!(std::abs(y) < short_series * x)) return std::atan2(y, x);
  const double tangent = y / x, squared = tangent * tangent;
  return tangent * (1 - squared * (1.0 / 3 - squared * (1.0 / 5 - squared * (1.0 / 7))));
}

/// Below `small_cell` a cell's centroid is that of its flat triangles; arcs up to `longest_arc` are measured
/// at once.
constexpr double small_cell = 1e-4, longest_arc = 0.25;  // radians

/// Adds up a cell over short arcs of its border.
class Sums {
 public:
  explicit Sums(const Direction& apex) : apex_(apex) {}

  /// Returns the arc's angle, which is the same to the last bit from its other end.
  double add(const Direction& from, const Direction& to) {
    const Direction a = from - apex_, b = to - apex_, across = cross(a, b);
    // Van Oosterom and Strackee 1983.
    const double solid =
        2 * angleOf(dot(apex_, across), 1 + dot(apex_, from) + dot(from, to) + dot(to, apex_));
    solid_ += solid;
    flat_ = flat_ + solid / 3 * (a + b);
    const Direction turn = cross(from, to);
    const double sine = lengthOf(turn), angle = angleOf(sine, dot(from, to));
    perimeter_ += angle;
    if (sine == 0) return angle;
    normals_ = normals_ + angle / (2 * sine) * turn;
    ellipsoid_ += turn.z * angle / sine * meanDifference(from, to, angle / 2);
    return angle;
  }

  /// Adds an arc of any length piece by piece.
  double add(const GreatArc& arc) {
    const int pieces = static_cast<int>(std::ceil(arc.angle / longest_arc));
    Direction last = arc.begin;
    for (int k = 1; k <= pieces; ++k) {
      const Direction here = k == pieces ? arc.end : pieceEnd(arc, k, pieces);
      add(last, here);
      last = here;
    }
    return arc.angle;
  }

  [[nodiscard]] SphereMeasures measures(bool is_small) const {
    const Direction center = is_small ? apex_ + 1 / solid_ * flat_ : normals_;
    return {solid_, squaredRadius() * (solid_ + ellipsoid_), perimeter_, normalized(center)};
  }

 private:
  /// The mean along an arc of half this angle to each side, by Gauss's rule of four points; of a short one,
  /// of two.
  static double meanDifference(const Direction& from, const Direction& to, double half_angle) {
    constexpr double is_short = 2e-3;  // the fourth power of this, by 270, is rounding
    if (half_angle < is_short) {
      constexpr double inner = 0.57735026918962576;
      const double middle = 0.5 * (from.z + to.z), half = 0.5 * (to.z - from.z);
      const auto [even, odd] = partsAt(inner, half_angle);
      return (difference(even * middle + odd * half) + difference(even * middle - odd * half)) / 2;
    }
    constexpr std::array<double, 2> at{0.33998104358485626, 0.86113631159405258};
    constexpr std::array<double, 2> weight{0.65214515486254614, 0.34785484513745386};
    const double middle = 0.5 * (from.z + to.z), half = 0.5 * (to.z - from.z);
    double sum = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      const auto [even, odd] = partsAt(at[k], half_angle);
      sum += weight[k] * (difference(even * middle + odd * half) + difference(even * middle - odd * half));
    }
    return sum / 2;
  }

  struct Parts {
    double of_middle, of_half;
  };
  /// The point of an arc at this part of its half, by its chord's middle and half.
  static Parts partsAt(double part, double half_angle) {
    constexpr double flat = 1e-3;
    const double angle = part * half_angle;
    if (half_angle >= flat) {
      return {std::cos(angle) / std::cos(half_angle), std::sin(angle) / std::sin(half_angle)};
    }
    const double lack = (half_angle * half_angle - angle * angle) / 2;
    return {1 + lack, part * (1 + lack / 3)};
  }

  Direction apex_;
  double solid_ = 0, perimeter_ = 0, ellipsoid_ = 0;
  Direction flat_{0, 0, 0}, normals_{0, 0, 0};
};

}  // namespace

double earthRadius() { return std::sqrt(squaredRadius()); }

SphereMeasures wholeSphere(const Direction& site) { return {4 * pi, 4 * pi * squaredRadius(), 0, site}; }

SphereMeasures measureCell(const SphereSites& sites, const SphereCell& cell, std::span<double> lengths) {
  constexpr double large = 1;  // radians
  const auto count = cell.vertex.size();
  double reach = 0;
  for (const Direction& vertex : cell.vertex) reach = std::max(reach, lengthOf(vertex - cell.direction));
  Direction apex = cell.direction;
  if (reach > large) {
    Direction center{0, 0, 0};
    for (std::size_t e = 0; e < count; ++e) {
      const GreatArc arc = arcOf(sites.vectors(), cell, e);
      center = center + arc.angle * arc.axis;
    }
    apex = normalized(center);
  }
  Sums sums(apex);
  for (std::size_t e = 0; e < count; ++e) {
    const auto next = e + 1 < count ? e + 1 : 0;
    const Direction &from = cell.vertex[e], &to = cell.vertex[next];
    const double angle = next != e && lengthOf(to - from) <= longest_arc
                             ? sums.add(from, to)
                             : sums.add(arcOf(sites.vectors(), cell, e));
    if (!lengths.empty()) lengths[e] = angle;
  }
  return sums.measures(reach < small_cell);
}

SphereMeasures measureRings(std::span<const Direction> vertices, std::span<const std::size_t> ends,
                            std::span<double> lengths) {
  Direction apex{0, 0, 0};
  for (const Direction& vertex : vertices) apex = apex + vertex;
  apex = normalized(apex);
  double reach = 0;
  for (const Direction& vertex : vertices) reach = std::max(reach, lengthOf(vertex - apex));
  Sums sums(apex);
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    for (auto e = begin; e < end; ++e) {
      const Direction &from = vertices[e], &to = vertices[e + 1 < end ? e + 1 : begin];
      lengths[e] = lengthOf(to - from) <= longest_arc
                       ? sums.add(from, to)
                       : sums.add(GreatArc{from, to, normalized(cross(from, to)), angleBetween(from, to)});
    }
    begin = end;
  }
  return sums.measures(reach < small_cell);
}

}  // namespace vorpipe::core
