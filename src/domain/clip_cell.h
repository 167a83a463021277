/// One cell clipped to an outline (decision D78).
#pragma once

#include <span>

#include "domain/crossings.h"
#include "domain/edge_tree.h"

namespace vorpipe::core {

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
