/// The vertices of a cell of many, by where they are.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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
  /// What its direction is to an axis: along it, and at a right angle to it (which rounding makes no less).
  [[nodiscard]] double along(const Point3& axis) const {
    return (axis.x * d_.x + axis.y * d_.y) + axis.z * d_.z;
  }
  [[nodiscard]] double across(double along) const {
    return std::sqrt(std::max(squared_ - along * along, 0.0) + 0x1p-49 * squared_);
  }
  [[nodiscard]] double half() const { return half_; }

 private:
  Relative d_;
  double half_, squared_, size_, fixed_;
};

/// Blocks of vertices that lie together, so that a cut need not look at all. New vertices belong to blocks of
/// removed ones, near which they lie; after many, the blocks are to be made anew. A block is a cylinder about
/// an axis through the site. It is flat where the vertices are on a sphere: a box would reach half its width
/// beyond that, and many more cuts would.
class VertexBlocks {
 public:
  explicit VertexBlocks(std::span<const VertexSpot> spots);
  /// As many vertices have moved or been added as there were at first.
  [[nodiscard]] bool isWorn() const { return changes_ > first_size_; }
  /// Appends the vertices that may lie above.
  void find(const HalfSpace& half_space, std::vector<std::uint32_t>& vertices) const;
  /// A vertex has another spot than it had. Call update() after the last.
  void move(std::uint32_t vertex);
  /// A new vertex, the last one, near another.
  void append(std::uint32_t near);
  /// The last vertex takes the number of another one, which goes.
  void replaceByLast(std::uint32_t vertex);
  void update(std::span<const VertexSpot> spots);
  [[nodiscard]] double largestSquared() const;

 private:
  struct Block {
    std::vector<std::uint32_t> vertices;
    bool touched = false;
    Point3 axis{1, 0, 0};      ///< of length 1
    double low = 0, high = 0;  ///< along it
    double across = 0;         ///< at most, from it
    double slack = 0, squared = 0;
  };
  void touch(std::uint32_t block);
  void measure(std::uint32_t block, std::span<const VertexSpot> spots);
  void make(std::span<std::uint32_t> vertices, std::span<const VertexSpot> spots);

  std::vector<Block> blocks_;
  std::vector<std::uint32_t> block_of_;  ///< by vertex
  std::vector<std::uint32_t> touched_;
  std::size_t first_size_, changes_ = 0;
};

}  // namespace vorpipe::space
