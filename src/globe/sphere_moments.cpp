#include "globe/sphere_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vorpipe::core {
namespace {

/// Radon's rule for triangles: the middle, and three points at each of two distances from it.
struct RadonPoint {
  double weight, a, b, c;
};
constexpr std::array<RadonPoint, 7> radonPoints() {
  constexpr double root = 3.8729833462074168852;  // of 15
  constexpr double inner = (6 - root) / 21, inner_weight = (155 - root) / 1200;
  constexpr double outer = (6 + root) / 21, outer_weight = (155 + root) / 1200;
  return {{{9.0 / 40, 1.0 / 3, 1.0 / 3, 1.0 / 3},
           {inner_weight, 1 - 2 * inner, inner, inner},
           {inner_weight, inner, 1 - 2 * inner, inner},
           {inner_weight, inner, inner, 1 - 2 * inner},
           {outer_weight, 1 - 2 * outer, outer, outer},
           {outer_weight, outer, 1 - 2 * outer, outer},
           {outer_weight, outer, outer, 1 - 2 * outer}}};
}

/// Adds up moments about a site over triangles.
class MomentSum {
 public:
  MomentSum(const Direction& site, const GlobeDensity* density) : site_(site), density_(density) {
    constexpr double longest = 0.02, pixels = 2;
    const double side = density != nullptr ? std::min(longest, pixels * density->pixel()) : longest;
    most_ = side * side;
  }

  void add(const Direction& a, const Direction& b, const Direction& c) {
    const double of_a = squared(c - b), of_b = squared(a - c), of_c = squared(b - a);
    const double longest = std::max({of_a, of_b, of_c});
    if (longest <= most_) return addPiece(a, b, c);
    if (longest == of_a) return addHalves(a, b, c);
    if (longest == of_b) return addHalves(b, c, a);
    addHalves(c, a, b);
  }

  [[nodiscard]] const SphereMoments& sum() const { return sum_; }

 private:
  static double squared(const Direction& a) { return dot(a, a); }

  /// The halves on both sides of the line from a corner to the middle of the side opposite.
  void addHalves(const Direction& from, const Direction& b, const Direction& c) {
    const Direction middle = normalized(b + c);
    add(from, b, middle);
    add(from, middle, c);
  }

  void addPiece(const Direction& a, const Direction& b, const Direction& c) {
    static constexpr auto points = radonPoints();
    const double flat = dot(a, cross(b - a, c - a)) / 2;
    for (const RadonPoint& point : points) {
      const Direction chord = point.a * a + point.b * b + point.c * c;
      const double scale = 1 / lengthOf(chord);
      const Direction x = scale * chord, way = x - site_;
      const double area = point.weight * flat * (scale * scale * scale);
      const double mass = density_ != nullptr ? area * density_->at(x) : area;
      sum_.area += area;
      sum_.mass += mass;
      sum_.lean = sum_.lean + mass * way;
      sum_.energy += mass * dot(way, way);
    }
  }

  Direction site_;
  const GlobeDensity* density_;
  double most_ = 0;  ///< of a side's squared length
  SphereMoments sum_;
};

void addWholeSphere(MomentSum& sum) {
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      for (const double z : {1.0, -1.0}) {
        const Direction a{x, 0, 0}, b{0, y, 0}, c{0, 0, z};
        x* y* z > 0 ? sum.add(a, b, c) : sum.add(a, c, b);
      }
    }
  }
}

}  // namespace

SphereMoments momentsOf(const SphereSites& sites, const SphereCell& cell, const GlobeDensity* density) {
  constexpr double large = 0.5, longest = 0.25;  // radians
  const Direction& own = cell.direction;
  MomentSum sum(own, density);
  const auto& vertex = cell.vertex;
  const auto count = vertex.size();
  if (count == 0) {
    addWholeSphere(sum);
    return sum.sum();
  }
  // Cells are convex, so that the mean of their vertices is inside. That of two may be 0.
  Direction middle{0, 0, 0};
  double reach = 0;
  for (std::size_t e = 0; e < count; ++e) {
    middle = middle + vertex[e];
    reach = std::max(reach, lengthOf(vertex[e] - vertex[0]));
  }
  const bool is_large = reach > large || count < 3;
  if (is_large) {
    middle = {0, 0, 0};
    for (std::size_t e = 0; e < count; ++e) {
      const GreatArc arc = arcOf(sites.vectors(), cell, e);
      middle = middle + arc.angle * arc.axis;
    }
  }
  middle = normalized(middle);
  for (std::size_t e = 0; e < count; ++e) {
    const Direction &from = vertex[e], &to = vertex[e + 1 < count ? e + 1 : 0];
    if (!is_large) {
      sum.add(middle, from, to);
      continue;
    }
    const GreatArc arc = arcOf(sites.vectors(), cell, e);
    const int pieces = static_cast<int>(std::ceil(arc.angle / longest));
    Direction last = from;
    for (int k = 1; k <= pieces; ++k) {
      const Direction here = k == pieces ? to : pointOn(arc, static_cast<double>(k) / pieces);
      sum.add(middle, last, here);
      last = here;
    }
  }
  return sum.sum();
}

double leastEnergyOnSphere(std::size_t count) {
  constexpr double pi = std::numbers::pi;
  // One site has the whole sphere, two have a half each: integrals of 2 - 2 x . p.
  if (count <= 2) return count == 1 ? 8 * pi : 4 * pi;
  const auto n = static_cast<double>(count);
  // An equilateral triangle of the area of 1 / (2 n - 4) sphere, in six from its middle: one has a corner at
  // the site, with an angle of pi / 6 + excess, a right one at the middle of a side, and one of
  // pi / 3.
  const double excess = pi / (3 * (n - 2)), angle = pi / 6 + excess, sine = std::sin(excess);
  const double tangent = std::sqrt(2 * sine * sine + std::sqrt(3.0) * std::sin(2 * excess));
  const double side = std::atan(tangent), far = std::atan2(tangent, std::cos(angle));
  const Direction site{0, 0, 1}, foot{std::sin(side), 0, std::cos(side)};
  MomentSum sum(site, nullptr);
  sum.add(site, foot, {std::sin(far) * std::cos(angle), std::sin(far) * std::sin(angle), std::cos(far)});
  return (12 * n - 24) * sum.sum().energy;
}

}  // namespace vorpipe::core
