#include <algorithm>
#include <cmath>
#include <cstddef>

#include "triangles.h"

namespace vorpipe::python {
namespace {

/// How far inside of a triangle a place is, as a part of the height over that side which it is most beyond.
struct Inside {
  double part;
  std::size_t corner;  ///< opposite to that side
};

double area2(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Inside insideOf(std::span<const Point> points, const Triangle& triangle, const Point& place) {
  const Point &a = points[triangle[0]], &b = points[triangle[1]], &c = points[triangle[2]];
  const double whole = area2(a, b, c);
  const double parts[] = {area2(b, c, place), area2(c, a, place), area2(a, b, place)};
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (parts[k] < parts[least]) least = k;
  }
  // Of a triangle too flat for doubles, only what lies on the right side of all three.
  return {whole > 0 ? parts[least] / whole : parts[least], least};
}

/// From triangle to triangle towards the place; `at` is where it begins and where it ends. In exact
/// arithmetic that comes to an end, in doubles it might go in circles where triangles are flat: then all are
/// looked at.
bool walk(std::span<const Point> points, std::span<const Triangle> triangles,
          std::span<const Adjacent> adjacent, const Point& place, double tolerance, std::size_t& at) {
  for (std::size_t steps = 0; steps <= triangles.size(); ++steps) {
    const Inside inside = insideOf(points, triangles[at], place);
    if (inside.part >= -tolerance) return true;
    const std::int32_t other = adjacent[at][inside.corner];
    if (other < 0) return false;
    at = static_cast<std::size_t>(other);
  }
  for (at = 0; at < triangles.size(); ++at) {
    if (insideOf(points, triangles[at], place).part >= -tolerance) return true;
  }
  at = 0;
  return false;
}

/// Row by row, to and fro: each place is near to the one before it, and so is the triangle that holds it.
std::vector<std::size_t> walkOrder(std::span<const Point> places) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (std::isfinite(places[i].x) && std::isfinite(places[i].y)) order.push_back(i);
  }
  if (order.size() < 2) return order;
  const auto [low, high] = std::ranges::minmax(order, {}, [&](std::size_t i) { return places[i].y; });
  const double bottom = places[low].y, height = places[high].y - bottom;
  const double rows = std::ceil(std::sqrt(static_cast<double>(order.size())));
  const auto rowOf = [&](std::size_t i) {
    return height > 0 ? std::min(std::floor((places[i].y - bottom) / height * rows), rows - 1) : 0;
  };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const double row_a = rowOf(a), row_b = rowOf(b);
    if (row_a != row_b) return row_a < row_b;
    const bool is_odd = std::fmod(row_a, 2) == 1;
    return is_odd ? places[b].x < places[a].x : places[a].x < places[b].x;
  });
  return order;
}

}  // namespace

std::vector<std::int32_t> trianglesAt(std::span<const Point> points, std::span<const Triangle> triangles,
                                      std::span<const Adjacent> adjacent, std::span<const Point> places,
                                      double tolerance) {
  std::vector<std::int32_t> found(places.size(), -1);
  std::size_t at = 0;
  for (const std::size_t i : walkOrder(places)) {
    if (walk(points, triangles, adjacent, places[i], tolerance, at)) found[i] = static_cast<std::int32_t>(at);
  }
  return found;
}

}  // namespace vorpipe::python
