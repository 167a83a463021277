/// Where an outline and a diagram meet exactly: corners of the outline on edges and vertices of cells, and
/// vertices on edges of the outline (decision D123). Rounding takes such places apart; as nodes of both they
/// are one again.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "domain/clipped_run.h"
#include "domain/ring_nodes.h"
#include "geometry/predicates.h"

namespace vorpipe::core {

/// Of the domain's shorter side: farther no tie moves a vertex, nor a cell without edges from its centroid.
inline constexpr double farthest_moved = 2e-4;

/// A cell in the box as a polygon, counter-clockwise, without edges whose ends are equal: side k runs from
/// vertex k to the next, with the neighbor k as in Diagram. Places are scaled.
struct CellSides {
  std::uint32_t cell;  ///< of the set
  std::span<const Point> vertices;
  std::span<const std::int64_t> neighbors;

  [[nodiscard]] std::size_t size() const { return vertices.size(); }
  [[nodiscard]] Point from(std::size_t k) const { return vertices[k]; }
  [[nodiscard]] Point to(std::size_t k) const { return vertices[k + 1 < size() ? k + 1 : 0]; }
  /// The neighbor whose side ends at vertex k.
  [[nodiscard]] std::int64_t before(std::size_t k) const { return neighbors[k > 0 ? k - 1 : size() - 1]; }
};

/// A vertex of the diagram whose place is known better than where it was rounded to, or moved by ties.
struct MovedVertex {
  Point from, to;
  /// A corner of the outline, where the vertex is without ties, rounded, or its foot on a side in its
  /// bisector.
  enum class Target : std::uint8_t { corner, crossing, foot } target;
};

struct Contacts {
  std::vector<MovedVertex> moved;
  std::vector<EdgeNode> nodes;       ///< vertices on edges, before they moved, and corners on other edges
  std::vector<std::uint32_t> cells;  ///< of the set, with a corner of the outline on a side or at a vertex
  bool faults = false;               ///< rounding has made the rings of a cell cross themselves
};

/// A place that is to become a point of a side, which runs from a to b in one of two cells: a is less.
struct SideNode {
  Point a, b, at;
};

/// A cell some of whose sides are several.
struct RefinedSides {
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;
  std::vector<std::size_t> part_of;  ///< the side that each was
};

/// Whether `neighbor` is a wall of the domain, and p does not lie in it. Ties may have joined a vertex to a
/// wall beside it: then cells with a side in that wall have both points as vertices, and other cells the
/// point off the wall.
bool isOffWall(const Box& domain, std::int64_t neighbor, Point p);

/// Sorts what insertCorners is to be given.
void sortNodes(std::vector<SideNode>& nodes);

/// Finds the contacts of one cell after the other. For one thread; keeps references.
class ContactFinder {
 public:
  ContactFinder(const ClippedRun& run, const OutlineIndex& index, double margin)
      : run_(run), index_(index), rings_(index.rings()), margin_(margin) {}

  /// Adds what a cell has in common with the edges `near`: all whose boxes come as near to it as `margin`.
  void find(const CellSides& sides, std::span<const std::uint32_t> near, Contacts& found);

  /// Replaces `refined` by a cell with the corners among the beginnings of `near` that lie on its sides, and
  /// `nodes`, sorted, as vertices; returns whether there are any. The cell on the other side of a side gets
  /// the same.
  bool insertCorners(const CellSides& sides, std::span<const std::uint32_t> near,
                     std::span<const SideNode> nodes, RefinedSides& refined);

 private:
  void findCorner(const CellSides& sides, Point corner, Contacts& found) const;
  void findTouching(Point corner, std::span<const std::uint32_t> near, Contacts& found);
  void findOnEdge(const CellSides& sides, std::uint32_t edge, Contacts& found) const;
  [[nodiscard]] bool isNearLine(Point a, Point b, Point p) const;
  [[nodiscard]] bool isOnSide(const CellSides& sides, std::size_t k, Point p) const;
  [[nodiscard]] int sideOfBorder(const CellSides& sides, std::int64_t neighbor, Point p) const;
  [[nodiscard]] bool isVertex(const CellSides& sides, std::size_t k, Point p) const;
  [[nodiscard]] bool isInLine(const CellSides& sides, std::int64_t neighbor, Point p, Point q) const;
  [[nodiscard]] std::optional<int> vertexSide(const CellSides& sides, std::size_t k, Point p, Point q) const;
  [[nodiscard]] Point placeOf(const CellSides& sides, std::size_t k) const;
  [[nodiscard]] std::int32_t inSet(std::uint32_t cell, std::int64_t neighbor) const;
  [[nodiscard]] WeightedPoint site(std::int32_t cell) const;

  const ClippedRun& run_;
  const OutlineIndex& index_;
  const Rings& rings_;
  double margin_;
  std::vector<Point> corners_, on_side_;
  std::vector<std::uint32_t> at_corner_;
};

/// Moves that are one for each vertex, whatever the order in which cells found them; ascending by where from.
std::vector<MovedVertex> agreed(std::vector<MovedVertex> moved);

/// Where a vertex has moved to, by agreed moves; itself if it has not.
Point movedPlace(std::span<const MovedVertex> moved, Point vertex);

}  // namespace vorpipe::core
