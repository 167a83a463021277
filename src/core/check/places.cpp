#include "core/check/places.h"

#include <algorithm>
#include <cmath>

namespace vorpipe::core::checks {
namespace {

constexpr std::size_t fewest_places = 2'000, most_places = 20'000, places_of_a_site = 256;

/// A number of [0, 1), the same on every platform.
double fraction(Random& random) { return std::ldexp(static_cast<double>(random() >> 11), -53); }

}  // namespace

std::vector<Point> samplePlaces(const CheckedCells& run, Random& random) {
  std::vector<Point> places(std::clamp(places_of_a_site * run.size(), fewest_places, most_places));
  const Box& box = run.domain;
  for (Point& p : places) {
    p.x = box.xmin + fraction(random) * (box.xmax - box.xmin);
    p.y = box.ymin + fraction(random) * (box.ymax - box.ymin);
  }
  return places;
}

double distance(Point p, Point a, Point b) {
  const Point edge = b - a, to = p - a;
  const double square = dot(edge, edge);
  const double along = square > 0 ? std::clamp(dot(to, edge) / square, 0.0, 1.0) : 0;
  return length(to - Point{along * edge.x, along * edge.y});
}

bool crossesRay(Point p, Point a, Point b) {
  if ((a.y > p.y) == (b.y > p.y)) return false;
  return (cross(b - a, p - a) > 0) == (b.y > a.y);
}

}  // namespace vorpipe::core::checks
