/// Where the rings of an outline cross the sides of one polygon, and the parts of rings inside of it.
#pragma once

#include <span>
#include <vector>

#include "core/outline/rings.h"

namespace vorpipe::core {

/// A polygon, counter-clockwise; side k runs from vertex k to the next.
struct Polygon {
  std::span<const Point> vertices;
  [[nodiscard]] std::size_t size() const { return vertices.size(); }
  [[nodiscard]] Point from(std::size_t k) const { return vertices[k]; }
  [[nodiscard]] Point to(std::size_t k) const { return vertices[k + 1 < size() ? k + 1 : 0]; }
};

/// Where an edge of a ring crosses a side of a polygon.
struct Crossing {
  std::size_t side;
  Point at;
  double along_edge, along_side;
  bool enters;  ///< whether the edge enters the polygon there
};

/// A part of a ring inside a polygon, between two crossings.
struct Arc {
  std::size_t enters = 0, leaves = 0;  ///< crossings
  std::vector<Point> points;           ///< of the ring, between them
};

inline constexpr std::size_t no_crossing = ~std::size_t{0};

/// Crossings and arcs of one polygon at a time; reuses its memory for the next.
class Crossings {
 public:
  explicit Crossings(const Rings& rings) : rings_(rings) {}

  /// Finds them for the edges `near`, ascending: all whose boxes meet the polygon's. False if they do not fit
  /// together, because the polygon crosses itself.
  bool find(const Polygon& polygon, std::span<const std::uint32_t> near);

  /// Orders the crossings as they stand around the polygon; false as find's. `inside` says whether its first
  /// vertex lies inside the rings.
  bool order(bool inside);

  [[nodiscard]] const std::vector<Crossing>& all() const { return crossings_; }
  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }
  [[nodiscard]] const std::vector<std::uint32_t>& wholeRings() const { return whole_; }
  /// Indices of all(), as order left them: in turns crossings that leave and that enter.
  [[nodiscard]] const std::vector<std::size_t>& around() const { return around_; }

 private:
  void cross(std::uint32_t edge);
  [[nodiscard]] bool isInside(Point p) const;
  bool traceRing(std::span<const std::uint32_t> edges);
  bool traceEdge(std::size_t first, std::size_t last, bool& inside);
  bool inTurns(std::vector<std::size_t>& crossings, bool enters_first, double Crossing::*along);

  const Rings& rings_;
  Polygon polygon_{};
  Box box_{};
  std::vector<std::uint32_t> near_;
  std::vector<Crossing> crossings_;
  std::vector<Arc> arcs_;
  std::vector<std::uint32_t> whole_;
  std::vector<std::size_t> around_, turn_;
  Arc open_;
};

}  // namespace vorpipe::core
