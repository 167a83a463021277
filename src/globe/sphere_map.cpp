#include "globe/sphere_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/degrees.h"

namespace vorpipe::core {
namespace {

// Savric, Patterson and Jenny 2018, "The Equal Earth map projection": a polynomial of the parametric
// latitude t, where sin(t) = sqrt(3) / 2 sin(latitude); the latitude is authalic, as in EPSG:8857.
constexpr double a1 = 1.340264, a2 = -0.081106, a3 = 0.000893, a4 = 0.003796;
const double half_of_root = std::sqrt(3.0) / 2;

/// The height above the equator, in radii.
double heightAt(double t) {
  const double t2 = t * t, t6 = t2 * t2 * t2;
  return t * (a1 + a2 * t2 + t6 * (a3 + a4 * t2));
}

/// How it grows with t.
double slopeAt(double t) {
  const double t2 = t * t, t6 = t2 * t2 * t2;
  return a1 + 3 * a2 * t2 + t6 * (7 * a3 + 9 * a4 * t2);
}

/// The distance from the middle meridian, in radii for each radian of longitude.
double widthAt(double t) { return std::cos(t) / (half_of_root * slopeAt(t)); }

/// The parametric latitude at a height, by Newton's method: the slope varies little.
double parameterAt(double height) {
  constexpr int steps = 8;
  double t = height / a1;
  for (int k = 0; k < steps; ++k) t -= (heightAt(t) - height) / slopeAt(t);
  return t;
}

double metersOfRadius() {
  constexpr double meters = 1000;
  return meters * earthRadius();
}

Box equalEarthBox() {
  const double radius = metersOfRadius();
  const double x = radius * std::numbers::pi * widthAt(0), y = radius * heightAt(std::asin(half_of_root));
  return {-x, -y, x, y};
}

}  // namespace

const Box& boxOfMap(const RenderOptions& options) {
  static const Box degrees{-antimeridian, -quarter_turn, antimeridian, quarter_turn}, disc{-1, -1, 1, 1},
      equal_earth = equalEarthBox();
  if (options.view_from) return disc;
  return options.map == GlobeMap::equal_earth ? equal_earth : degrees;
}

SphereMap::SphereMap(const RenderOptions& options)
    : equal_earth_(!options.view_from && options.map == GlobeMap::equal_earth),
      seen_from_(options.view_from.has_value()),
      box_(boxOfMap(options)),
      shown_width_(options.view ? options.view->xmax - options.view->xmin : box_.xmax - box_.xmin) {
  if (!seen_from_) return;
  viewer_ = directionOf(*options.view_from);
  right_ = directionOf({options.view_from->x + quarter_turn, 0});
  up_ = cross(viewer_, right_);
}

Point SphereMap::flat(Point degrees) const {
  if (!equal_earth_) return degrees;
  const double radius = metersOfRadius();
  const double t = std::asin(half_of_root * authalic(degrees.y).sine);
  return {radius * widthAt(t) * degrees.x * degree, radius * heightAt(t)};
}

std::optional<Point> SphereMap::at(const Direction& direction) const {
  if (isFlat()) return flat(placeOf(direction));
  if (dot(viewer_, direction) < 0) return std::nullopt;
  return seen(direction);
}

std::vector<Point> SphereMap::border() const {
  std::vector<Point> ring;
  if (seen_from_) {
    constexpr int steps = 720;
    for (int k = 0; k < steps; ++k) {
      const double angle = k * (whole_turn / steps) * degree;
      ring.push_back({std::cos(angle), std::sin(angle)});
    }
  } else if (equal_earth_) {
    constexpr auto steps = static_cast<int>(2 * quarter_turn / border_step);
    for (int k = 0; k <= steps; ++k) ring.push_back(flat({antimeridian, k * border_step - quarter_turn}));
    for (int k = steps; k >= 0; --k) ring.push_back(flat({-antimeridian, k * border_step - quarter_turn}));
  }
  return ring;
}

SphereMap::Row::Row(const SphereMap& map, double y) : map_(map), y_(y) {
  if (!map.isFlat()) return;
  double latitude = y;
  radians_ = degree;
  if (map.equal_earth_) {
    const double radius = metersOfRadius(), t = parameterAt(y / radius);
    latitude = geodetic(std::asin(std::clamp(std::sin(t) / half_of_root, -1.0, 1.0)));
    radians_ = 1 / (radius * widthAt(t));
  }
  const Direction at = directionOf({0, latitude});
  sine_ = at.z;
  cosine_ = at.x;
}

std::optional<Direction> SphereMap::Row::at(double x) const {
  if (!(y_ >= map_.box_.ymin && y_ <= map_.box_.ymax)) return std::nullopt;
  if (map_.isFlat()) {
    const double longitude = radians_ * x;
    if (!(std::abs(longitude) <= std::numbers::pi)) return std::nullopt;
    return Direction{cosine_ * std::cos(longitude), cosine_ * std::sin(longitude), sine_};
  }
  const double squared = 1 - (x * x + y_ * y_);
  if (!(squared >= 0)) return std::nullopt;
  return x * map_.right_ + y_ * map_.up_ + std::sqrt(squared) * map_.viewer_;
}

}  // namespace vorpipe::core
