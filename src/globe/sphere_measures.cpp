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

/// cos(p t) / cos(t) and sin(p t) / (p sin(t)), less 1, as series in t^2 (1 - p^2), up to t = `short_half`.
class PointOfHalf {
 public:
  static constexpr double short_half = 0.02;

  constexpr explicit PointOfHalf(double part) : part_(part) {
    const double p = part * part, q = p * p;
    even_ = {1.0 / 2, (5 - p) / 24, (61 - 14 * p + q) / 720, (1385 - (323 - (27 - p) * p) * p) / 40320};
    odd_ = {1.0 / 6, (7 - 3 * p) / 360, (31 - 18 * p + 3 * q) / 15120,
            (381 - (239 - (55 - 5 * p) * p) * p) / 1814400};
  }

  struct Shares {
    double of_middle, of_half;
  };
  /// The place of an arc at this part of its half angle, by its chord's middle and half.
  [[nodiscard]] Shares at(double half_angle) const {
    if (half_angle >= short_half) {
      const double angle = part_ * half_angle;
      return {std::cos(angle) / std::cos(half_angle), std::sin(angle) / std::sin(half_angle)};
    }
    const double squared = half_angle * half_angle, lack = (1 - part_ * part_) * squared;
    const auto sum = [squared](const std::array<double, 4>& series) {
      return series[0] + squared * (series[1] + squared * (series[2] + squared * series[3]));
    };
    return {1 + lack * sum(even_), part_ * (1 + lack * sum(odd_))};
  }

 private:
  double part_;
  std::array<double, 4> even_{}, odd_{};
};

/// Adds up a cell over short arcs of its border.
class Sums {
 public:
  /// `is_small`: the centroid is to be that of flat triangles from the apex.
  Sums(const Direction& apex, bool is_small) : apex_(apex), is_small_(is_small) {}

  /// Returns the arc's angle, which is the same to the last bit from its other end.
  double add(const Direction& from, const Direction& to) {
    const Direction a = from - apex_, b = to - apex_, across = cross(a, b);
    // Van Oosterom and Strackee 1983.
    const double solid =
        2 * angleOf(dot(apex_, across), 1 + dot(apex_, from) + dot(from, to) + dot(to, apex_));
    solid_ += solid;
    if (is_small_) center_ = center_ + solid / 3 * (a + b);
    const Direction turn = cross(from, to);
    const double sine = lengthOf(turn), angle = angleOf(sine, dot(from, to));
    perimeter_ += angle;
    if (sine == 0) return angle;
    const double longer = angle / sine;
    if (!is_small_) center_ = center_ + longer / 2 * turn;
    ellipsoid_ += turn.z * longer * meanDifference(from, to, angle / 2);
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

  [[nodiscard]] SphereMeasures measures() const {
    const Direction center = is_small_ ? apex_ + 1 / solid_ * center_ : center_;
    return {solid_, squaredRadius() * (solid_ + ellipsoid_), perimeter_, normalized(center)};
  }

 private:
  /// The mean along an arc of half this angle to each side, by Gauss's rules of two, three and four points.
  static double meanDifference(const Direction& from, const Direction& to, double half_angle) {
    // The fourth power of the first, by 270, is rounding, and the sixth of the second, by 31500.
    constexpr double for_two = 2e-3, for_three = PointOfHalf::short_half;
    const double middle = 0.5 * (from.z + to.z), half = 0.5 * (to.z - from.z);
    const auto atBoth = [&](const PointOfHalf& point) {
      const auto [even, odd] = point.at(half_angle);
      return difference(even * middle + odd * half) + difference(even * middle - odd * half);
    };
    if (half_angle < for_two) {
      static constexpr PointOfHalf inner(0.57735026918962576);
      return atBoth(inner) / 2;
    }
    if (half_angle < for_three) {
      static constexpr PointOfHalf center(0), outer(0.77459666924148338);
      return (8 * difference(center.at(half_angle).of_middle * middle) + 5 * atBoth(outer)) / 18;
    }
    static constexpr PointOfHalf inner(0.33998104358485626), outer(0.86113631159405258);
    return (0.65214515486254614 * atBoth(inner) + 0.34785484513745386 * atBoth(outer)) / 2;
  }

  Direction apex_;
  bool is_small_;
  double solid_ = 0, perimeter_ = 0, ellipsoid_ = 0;
  Direction center_{0, 0, 0};
};

}  // namespace

double earthRadius() { return std::sqrt(squaredRadius()); }

SphereMeasures wholeSphere(const Direction& site) { return {4 * pi, 4 * pi * squaredRadius(), 0, site}; }

SphereMeasures measureCell(const SphereSites& sites, const SphereCell& cell, std::span<double> lengths) {
  constexpr double large = 1;  // radians
  const auto count = cell.vertex.size();
  const auto squareOf = [](const Direction& a) { return dot(a, a); };
  double reach = 0;
  for (const Direction& vertex : cell.vertex) reach = std::max(reach, squareOf(vertex - cell.direction));
  Direction apex = cell.direction;
  if (reach > large * large) {
    Direction center{0, 0, 0};
    for (std::size_t e = 0; e < count; ++e) {
      const GreatArc arc = arcOf(sites.vectors(), cell, e);
      center = center + arc.angle * arc.axis;
    }
    apex = normalized(center);
  }
  Sums sums(apex, reach < small_cell * small_cell);
  for (std::size_t e = 0; e < count; ++e) {
    const auto next = e + 1 < count ? e + 1 : 0;
    const Direction &from = cell.vertex[e], &to = cell.vertex[next];
    const double angle = next != e && squareOf(to - from) <= longest_arc * longest_arc
                             ? sums.add(from, to)
                             : sums.add(arcOf(sites.vectors(), cell, e));
    if (!lengths.empty()) lengths[e] = angle;
  }
  return sums.measures();
}

SphereMeasures measureRings(std::span<const Direction> vertices, std::span<const std::size_t> ends,
                            std::span<double> lengths) {
  Direction apex{0, 0, 0};
  for (const Direction& vertex : vertices) apex = apex + vertex;
  apex = normalized(apex);
  double reach = 0;
  for (const Direction& vertex : vertices) reach = std::max(reach, lengthOf(vertex - apex));
  Sums sums(apex, reach < small_cell);
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
  return sums.measures();
}

}  // namespace vorpipe::core
