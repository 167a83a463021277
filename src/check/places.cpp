#include "check/places.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

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

void cutRing(Point normal, double offset, std::vector<Point>& ring) {
  std::vector<Point> kept;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], b = ring[k + 1 < ring.size() ? k + 1 : 0];
    const double at_a = offset - dot(a, normal), at_b = offset - dot(b, normal);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a < 0) == (at_b < 0)) continue;
    const double along = at_a / (at_a - at_b);
    Point p{a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)};
    // On an axis-parallel line the point is exact.
    if (normal.y == 0) p.x = offset / normal.x;
    if (normal.x == 0) p.y = offset / normal.y;
    kept.push_back(p);
  }
  ring = std::move(kept);
}

double areaOf(std::span<const Point> ring) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) twice += cross(ring[k] - ring[0], ring[k + 1] - ring[0]);
  return twice / 2;
}

bool crossesRay(Point p, Point a, Point b) {
  if ((a.y > p.y) == (b.y > p.y)) return false;
  return (cross(b - a, p - a) > 0) == (b.y > a.y);
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (order_.empty()) return;
  nodes_.resize(2 * std::bit_ceil(order_.size() / leaf_size + 1));
  build({1, 0, order_.size()});
}

void BoxTree::build(const Node& node) {
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  Box all = boxes_[order_[node.begin]];
  for (std::size_t k = node.begin; k < node.end; ++k) {
    const Box& box = boxes_[order_[k]];
    all = {std::min(all.xmin, box.xmin), std::min(all.ymin, box.ymin), std::max(all.xmax, box.xmax),
           std::max(all.ymax, box.ymax)};
  }
  nodes_[node.number] = all;
  if (node.isLeaf()) return;
  const bool across_x = all.xmax - all.xmin > all.ymax - all.ymin;
  const auto place = [&](std::uint32_t k) {
    const Box& box = boxes_[k];
    return across_x ? box.xmin + box.xmax : box.ymin + box.ymax;
  };
  std::ranges::nth_element(at(node.begin), at(node.middle()), at(node.end), {}, place);
  build(node.lower());
  build(node.upper());
}

}  // namespace vorpipe::core::checks
