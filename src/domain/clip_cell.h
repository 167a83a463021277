/// One cell clipped to an outline (decision D78).
#pragma once

#include <span>
#include <vector>

#include "domain/edge_tree.h"
#include "domain/rings.h"
#include "geometry/polygon_measures.h"

namespace vorpipe::core {

/// A polygon, counter-clockwise; side k runs from vertex k to the next.
struct Polygon {
  std::span<const Point> vertices;
  [[nodiscard]] std::size_t size() const { return vertices.size(); }
  [[nodiscard]] Point from(std::size_t k) const { return vertices[k]; }
  [[nodiscard]] Point to(std::size_t k) const { return nextOf(vertices, k); }
};

/// The crossing of a ring's edge with a side of a polygon.
struct Crossing {
  std::uint32_t edge;
  std::size_t side;
  Point at;
  bool enters;  ///< whether the edge enters the polygon there
};

/// A part of a ring inside a polygon, between two crossings.
struct RingPart {
  std::size_t enters = 0, leaves = 0;  ///< crossings
  std::vector<Point> points;           ///< of the ring, between them
};

/// An edge of a border, which has the inside to its left.
struct BorderEdge {
  Point from, to;
  std::size_t side;  ///< of the polygon; no_crossing along a ring
};

inline constexpr std::size_t no_crossing = ~std::size_t{0};

/// Crossings and arcs of one polygon at a time; reuses its memory.
class Crossings {
 public:
  explicit Crossings(const Rings& rings) : rings_(rings) {}

  /// Finds them for the edges `near`, ascending: all whose boxes meet the polygon's. Returns false if they
  /// are inconsistent, because the polygon crosses itself.
  bool find(const Polygon& polygon, std::span<const std::uint32_t> near);

  /// Orders the crossings around the polygon; returns false as find() does. `inside`: whether its first
  /// vertex lies inside the rings.
  bool order(bool inside);

  /// Replaces `edges` by the border of the intersection of the rings and a polygon, both of which may cross
  /// themselves. The border's winding numbers are theirs. `turns`: the winding number of the rings around
  /// each vertex.
  void border(const Polygon& polygon, std::span<const std::uint32_t> near, std::span<const int> turns,
              std::vector<BorderEdge>& edges);

  [[nodiscard]] const std::vector<Crossing>& all() const { return crossings_; }
  [[nodiscard]] const std::vector<RingPart>& arcs() const { return arcs_; }
  [[nodiscard]] const std::vector<std::uint32_t>& wholeRings() const { return whole_; }
  /// Indices into all(), in the order that order() established: crossings that leave and that enter
  /// alternate.
  [[nodiscard]] const std::vector<std::size_t>& around() const { return around_; }

 private:
  void take(const Polygon& polygon, std::span<const std::uint32_t> near);
  void cross(std::uint32_t edge);
  [[nodiscard]] int turnsAround(Point p) const;
  void addPieces(std::vector<std::size_t>& crossings, Point from, Point to, int times, std::size_t side,
                 std::vector<BorderEdge>& edges) const;
  [[nodiscard]] bool isInside(Point p) const { return turnsAround(p) % 2 != 0; }
  bool traceRing(std::span<const std::uint32_t> edges);
  bool traceEdge(std::size_t first, std::size_t last, bool& inside);
  bool inTurns(std::vector<std::size_t>& crossings, bool enters_first, Point from, Point to);

  const Rings& rings_;
  Polygon polygon_{};
  Box box_{};
  std::vector<std::uint32_t> near_;
  std::vector<Crossing> crossings_;
  std::vector<RingPart> arcs_;
  std::vector<std::uint32_t> whole_;
  std::vector<std::size_t> around_, turn_;
  RingPart open_;
};

/// The part of a cell that remains: rings one after another, outer ones counter-clockwise, each followed by
/// its holes, clockwise. Edge k runs from vertex k to the next of its ring.
struct ClippedCell {
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;     ///< of each edge; wall_outline along the outline
  std::vector<std::uint32_t> ring_starts;  ///< the first vertex of each ring
  std::vector<bool> hole;                  ///< whether each ring is a hole
  /// Edges between sites, sorted by neighbor and by start point; empty until sortEdges.
  std::vector<std::uint32_t> sorted_edges;

  void clear();
  [[nodiscard]] std::span<const Point> ring(std::size_t r) const;
  /// The end points of all edges.
  [[nodiscard]] std::vector<Point> ends() const;
  /// The end point of an edge.
  [[nodiscard]] Point endOf(std::uint32_t edge) const;

  /// Sorts edges for fast lookup: cells that a long outline cuts into many parts share thousands of edges.
  void sortEdges();
  /// Whether an edge with a site as neighbor runs from a to b. Requires sortEdges.
  [[nodiscard]] bool hasEdge(std::int64_t neighbor, Point a, Point b) const;
};

/// Clips polygons. Every decision is exact. If two polygons share an edge, crossings on it are bitwise equal
/// in both: the parts of polygons that cover the plane cover the inside.
class OutlineClip {
 public:
  /// Keeps a reference.
  explicit OutlineClip(const OutlineIndex& index);
  ~OutlineClip();
  OutlineClip(const OutlineClip&) = delete;
  OutlineClip& operator=(const OutlineClip&) = delete;

  enum class Outcome : std::uint8_t {
    inside,
    outside,
    cut,
    crossed,  ///< the polygon crosses itself and leaves no rings; border() returns what remains
  };

  /// Clips the polygon of these vertices, counter-clockwise, whose edge k has the neighbor k. `near` lists,
  /// ascending, the outline's edges whose boxes meet the polygon's, and perhaps others. `clipped` is replaced
  /// if the outcome is `cut`. A polygon that crosses itself is detected only if its crossings with the
  /// outline are inconsistent.
  Outcome clip(std::span<const Point> vertices, std::span<const std::int64_t> neighbors,
               std::span<const std::uint32_t> near, ClippedCell& clipped);

  /// Replaces `edges` by the border of the remaining part of the same polygon, whose edges may cross.
  void border(std::span<const Point> vertices, std::span<const std::uint32_t> near,
              std::vector<BorderEdge>& edges);

  /// The crossings of the polygon clipped last.
  [[nodiscard]] std::span<const Crossing> crossings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::core
