/// One cell clipped to an outline (decision D78).
#pragma once

#include <span>

#include "domain/crossings.h"
#include "domain/edge_tree.h"

namespace vorpipe::core {

/// What is left of a cell: rings one after another, outer ones counter-clockwise, each followed by its holes,
/// clockwise. Edge k runs from vertex k to the next of its ring.
struct ClippedCell {
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;     ///< of each edge; wall_outline along the outline
  std::vector<std::uint32_t> ring_starts;  ///< the first vertex of each ring
  std::vector<bool> hole;                  ///< whether each ring is one
  /// Edges between sites, by the neighbor and by where they begin; none until sortEdges.
  std::vector<std::uint32_t> sorted_edges;

  void clear();
  [[nodiscard]] std::span<const Point> ring(std::size_t r) const;
  /// Where all edges end.
  [[nodiscard]] std::vector<Point> ends() const;
  /// Where an edge ends.
  [[nodiscard]] Point endOf(std::uint32_t edge) const;

  /// Has edges be found quickly: cells that a long outline cuts into many parts have thousands in common.
  void sortEdges();
  /// Whether an edge with a site as neighbor runs from a to b. To be called after sortEdges.
  [[nodiscard]] bool hasEdge(std::int64_t neighbor, Point a, Point b) const;
};

/// Clips polygons. Every decision is exact, and where two polygons share an edge, crossings on it are the
/// same points to the bit in both: the parts of polygons that cover the plane cover the inside.
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
    crossed,  ///< a polygon that crosses itself leaves no rings; border() has what is left
  };

  /// Clips the polygon of these vertices, counter-clockwise, whose edge k has the neighbor k. `near` has the
  /// outline's edges whose boxes meet the polygon's, and perhaps others, ascending. `clipped` is replaced
  /// where the outcome is `cut`. That a polygon crosses itself is seen only where the outline does not fit
  /// it.
  Outcome clip(std::span<const Point> vertices, std::span<const std::int64_t> neighbors,
               std::span<const std::uint32_t> near, ClippedCell& clipped);

  /// Replaces `edges` by the border of what is left of the same polygon, of which edges may cross.
  void border(std::span<const Point> vertices, std::span<const std::uint32_t> near,
              std::vector<BorderEdge>& edges);

  /// Of the polygon clipped last.
  [[nodiscard]] std::span<const Crossing> crossings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vorpipe::core
