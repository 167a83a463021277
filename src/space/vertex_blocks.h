/// The vertices of a cell of many, by where they are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "space/relative.h"

namespace vorpipe::space {

/// Where a vertex is, relative to its cell's site.
struct VertexSpot {
  double x, y, z;
  double slack;    ///< times the length of d, it bounds the error of the product with d
  double squared;  ///< its distance from the site, squared: an upper bound
};

/// What a bisector, or any half-space 2 p . d <= lift, has to do with vertices.
class HalfSpace {
 public:
  explicit HalfSpace(const Relative& of);
  /// Above the half-space if positive; at most error() off.
  [[nodiscard]] double above(double x, double y, double z) const {
    return ((x * d_.x + y * d_.y) + z * d_.z) - half_;
  }
  [[nodiscard]] double error(double slack) const { return slack * size_ + fixed_; }
  /// No less than above() of any place in that box.
  [[nodiscard]] double mostAbove(const Point3& low, const Point3& high) const {
    return above(d_.x > 0 ? high.x : low.x, d_.y > 0 ? high.y : low.y, d_.z > 0 ? high.z : low.z);
  }

 private:
  Relative d_;
  double half_, size_, fixed_;
};

/// Blocks of vertices that lie together, so that a cut need not look at all. New vertices take the places of
/// removed ones, near which they lie.
class VertexBlocks {
 public:
  explicit VertexBlocks(std::span<const VertexSpot> spots);
  /// Appends the vertices that may lie above.
  void find(const HalfSpace& half_space, std::vector<std::uint32_t>& vertices) const;
  /// A vertex has another spot than it had. Call update() after the last.
  void move(std::uint32_t vertex) { touch(block_of_[vertex]); }
  /// A new vertex, the last one, near another.
  void append(std::uint32_t near);
  /// The last vertex takes the number of another one, which goes.
  void replaceByLast(std::uint32_t vertex);
  void update(std::span<const VertexSpot> spots);
  [[nodiscard]] double largestSquared() const;

 private:
  struct Block {
    std::vector<std::uint32_t> vertices;
    Point3 low, high;
    double slack, squared;
    bool touched;
  };
  void touch(std::uint32_t block);
  void measure(std::uint32_t block, std::span<const VertexSpot> spots);

  std::vector<Block> blocks_;
  std::vector<std::uint32_t> block_of_;  ///< by vertex
  std::vector<std::uint32_t> touched_;
};

}  // namespace vorpipe::space
