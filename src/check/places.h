/// Sample places of the domain for checks, their position relative to an edge, and boxes to search in.
#pragma once

#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "check/run.h"
#include "vorpipe.h"

namespace vorpipe::core::checks {

using Random = std::mt19937_64;

/// Places anywhere in the domain, the same on every platform: 256 for each site, but at least 2,000 and at
/// most 20,000. With nine sites, 20,000 took ten times as long as all other checks together.
std::vector<Point> samplePlaces(const CheckedCells& run, Random& random);

/// Sort key of places: their bits, since in broken diagrams some are NaN, which has no order. 0 and -0 are
/// the same place.
struct PlaceKey {
  explicit PlaceKey(Point p)
      : x(std::bit_cast<std::uint64_t>(p.x + 0.0)), y(std::bit_cast<std::uint64_t>(p.y + 0.0)) {}
  std::uint64_t x, y;
  auto operator<=>(const PlaceKey&) const = default;
};

/// Distance from p to the nearest point of the segment from a to b.
double distance(Point p, Point a, Point b);

/// Reduces a ring to its part where dot(p, normal) <= offset (Sutherland and Hodgman 1974), in place.
/// Separate parts of the result are joined along the line, which does not change the area.
void cutRing(Point normal, double offset, std::vector<Point>& ring);

/// The area of a counter-clockwise ring.
double areaOf(std::span<const Point> ring);

/// Whether the segment from a to b crosses the ray from p to the right.
bool crossesRay(Point p, Point a, Point b);

/// The box that two points span.
inline Box boxAround(Point a, Point b) {
  return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y};
}

/// `box` grown by `margin` on each side.
inline Box grown(const Box& box, double margin) {
  return {box.xmin - margin, box.ymin - margin, box.xmax + margin, box.ymax + margin};
}

/// A tree of boxes, split repeatedly in halves across the longer side of the remaining box. However the boxes
/// lie, the number of nodes is at most a few times that of boxes.
class BoxTree {
 public:
  /// The boxes are finite, and fewer than 2^32.
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls take(k) for each box k that meets or touches `asked`, whose sides may be infinite.
  template <class Take>
  void eachMeeting(const Box& asked, const Take& take) const {
    if (!order_.empty()) visit({1, 0, order_.size()}, asked, take);
  }

 private:
  static constexpr std::size_t leaf_size = 8;
  struct Node {
    std::size_t number, begin, end;  ///< its boxes are order_[begin] .. order_[end - 1]
    [[nodiscard]] bool isLeaf() const { return end - begin <= leaf_size; }
    [[nodiscard]] std::size_t middle() const { return begin + (end - begin) / 2; }
    [[nodiscard]] Node lower() const { return {2 * number, begin, middle()}; }
    [[nodiscard]] Node upper() const { return {2 * number + 1, middle(), end}; }
  };

  static bool meet(const Box& a, const Box& b) {
    return a.xmin <= b.xmax && b.xmin <= a.xmax && a.ymin <= b.ymax && b.ymin <= a.ymax;
  }
  void build(const Node& node);

  template <class Take>
  void visit(const Node& node, const Box& asked, const Take& take) const {
    if (!meet(nodes_[node.number], asked)) return;
    if (!node.isLeaf()) {
      visit(node.lower(), asked, take);
      visit(node.upper(), asked, take);
      return;
    }
    for (std::size_t k = node.begin; k < node.end; ++k) {
      if (meet(boxes_[order_[k]], asked)) take(order_[k]);
    }
  }

  std::vector<Box> boxes_, nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace vorpipe::core::checks
