/// Exact contacts of an outline and a diagram: corners of the outline on edges and vertices of cells, and
/// vertices on edges of the outline (decision D123). Rounding separates such points; as nodes of both they
/// coincide again.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "domain/clipped_records.h"
#include "domain/edge_tree.h"
#include "geometry/predicates.h"

namespace vorpipe::core {

/// As a part of the domain's shorter side: ties move no vertex farther than this, nor a cell without edges
/// farther from its centroid.
inline constexpr double farthest_moved = 2e-4;

/// A cell in the box as a polygon, counter-clockwise, without edges whose ends are equal. Side k runs from
/// vertex k to the next, with neighbor k as in Diagram. Coordinates are scaled.
struct CellSides : Polygon {
  std::uint32_t cell;  ///< of the set
  std::span<const std::int64_t> neighbors;

  /// The neighbor whose side ends at vertex k.
  [[nodiscard]] std::int64_t before(std::size_t k) const { return neighbors[k > 0 ? k - 1 : size() - 1]; }
};

/// A vertex of the diagram with a position more accurate than the one that rounding or ties gave it.
struct MovedVertex {
  Point from, to;
  /// A corner of the outline; the vertex without ties, rounded; or the vertex's foot on a side within its
  /// bisector.
  enum class Target : std::uint8_t { corner, crossing, foot } target;
};

struct Contacts {
  std::vector<MovedVertex> moved;
  std::vector<EdgeNode> nodes;       ///< vertices on edges, before they moved; corners on other edges
  std::vector<std::uint32_t> cells;  ///< indices in the set: cells with a corner on a side or at a vertex
  bool faults = false;               ///< rounding has made the rings of a cell cross themselves
};

/// A point to insert into a side, which runs from a to b in one of its two cells: a is less.
struct SideNode {
  Point a, b, at;
};

/// A cell with some sides split into several.
struct RefinedSides {
  std::vector<Point> vertices;
  std::vector<std::int64_t> neighbors;
  std::vector<std::size_t> part_of;  ///< the original side of each
};

/// Whether `neighbor` is a wall of the domain and p does not lie on it. Ties may have joined a vertex to a
/// nearby wall. Then cells with a side on that wall have both points as vertices, and other cells only the
/// point off the wall.
bool isOffWall(const Box& domain, std::int64_t neighbor, Point p);

/// Sorts nodes for insertCorners.
void sortNodes(std::vector<SideNode>& nodes);

/// Finds the contacts of cells, one by one. For one thread; keeps references.
class ContactFinder {
 public:
  ContactFinder(const ClippedRun& run, const OutlineIndex& index, double margin)
      : run_(run), index_(index), rings_(index.rings()), margin_(margin) {}

  /// Adds the contacts of a cell with the edges `near`: all whose boxes come within `margin` of it.
  void find(const CellSides& sides, std::span<const std::uint32_t> near, Contacts& found);

  /// Replaces `refined` by the cell with more vertices: the corners among the start points of `near` that lie
  /// on its sides, and `nodes`, sorted. Returns whether there are any. The cell on the other side gets the
  /// same vertices.
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

/// Returns one move for each vertex, independent of the order in which cells found them; ascending by old
/// position.
std::vector<MovedVertex> agreed(std::vector<MovedVertex> moved);

/// The new position of a vertex by agreed moves; the vertex itself if it has not moved.
Point movedPlace(std::span<const MovedVertex> moved, Point vertex);

}  // namespace vorpipe::core
