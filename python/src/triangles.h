/// What vorpipe.compat makes of the Delaunay triangles of a diagram: how they hang together.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vorpipe.h"

namespace vorpipe::python {

using Triangle = std::array<std::uint32_t, 3>;
using Adjacent = std::array<std::int32_t, 3>;  ///< by corner: the triangle opposite to it, or -1

std::vector<Adjacent> adjacentTriangles(std::span<const Triangle> triangles, std::size_t points);

/// The triangles around each point, counter-clockwise; where they do not go all around, from the hull's edge.
struct Fans {
  std::vector<std::int64_t> offsets;  ///< points + 1
  std::vector<std::int32_t> triangles;
  std::vector<std::uint8_t> are_closed;  ///< by point
};
Fans fansOf(std::span<const Triangle> triangles, std::span<const Adjacent> adjacent, std::size_t points);

struct Mesh {
  std::vector<Triangle> triangles;
  std::vector<Adjacent> adjacent;
};

/// The Delaunay triangles as far as doubles can tell. A diagram's come near: where an edge between cells has
/// less than 1e-6 of their sites' distance, its two triangles are a tie, and may be those on the other side
/// of it. With `exactly`, those that exact arithmetic tells.
Mesh flipped(std::span<const Point> points, std::span<const Triangle> triangles,
             std::span<const Adjacent> adjacent, bool exactly = false);

/// Whether each triangle lies between the hull and a point that is on it as far as doubles can tell.
std::vector<std::uint8_t> flatOnHull(std::span<const Point> points, std::span<const Triangle> triangles,
                                     std::span<const Adjacent> adjacent);

/// Triangles whose corners lie on one circle, as far as doubles can tell, share a center.
struct Centers {
  std::vector<std::int32_t> of_triangle;  ///< index of its center
  std::vector<Point> positions;           ///< not finite where the triangle is too flat to tell
  std::vector<std::int32_t> triangles;    ///< by center: the triangle that it was computed from
};
Centers centersOf(std::span<const Point> points, std::span<const Triangle> triangles,
                  std::span<const Adjacent> adjacent);

/// The triangle that holds each place, or -1; where the edges of several do, one of them. A place counts as
/// inside up to `tolerance` of a triangle's heights. There is at least one triangle.
std::vector<std::int32_t> trianglesAt(std::span<const Point> points, std::span<const Triangle> triangles,
                                      std::span<const Adjacent> adjacent, std::span<const Point> places,
                                      double tolerance);

}  // namespace vorpipe::python
