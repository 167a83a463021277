/// Cells as combinatorics alone: faces, and the faces around each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "space/label.h"

namespace vorpipe::space {

/// A ring: the faces across the edges of a face, as indices into the row, counter-clockwise seen from outside.
/// Consecutive ones, r[k] and r[k + 1], meet in a vertex of the face; the edge between the vertices
/// (r[k - 1], r[k]) and (r[k], r[k + 1]) belongs to r[k].
class Ring {
 public:
  Ring(const std::uint8_t* small, const std::uint32_t* large, std::size_t size)
      : small_(small), large_(large), size_(size) {}
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t operator[](std::size_t k) const { return large_ ? large_[k] : small_[k]; }

 private:
  const std::uint8_t* small_;
  const std::uint32_t* large_;
  std::size_t size_;
};

/// The cell of one site. It has none if there are no faces.
class Row {
 public:
  std::uint32_t faces = 0, edge_ends = 0;  ///< edge_ends: the sum of all rings' sizes, twice the edges
  const Label* neighbor = nullptr;         ///< by face
  const std::uint32_t* ring_begin = nullptr;  ///< by face, and one more: where its ring begins
  const std::uint8_t* small = nullptr;        ///< the rings, one of the two
  const std::uint32_t* large = nullptr;

  [[nodiscard]] Ring ring(std::size_t face) const {
    const std::size_t begin = ring_begin[face], size = ring_begin[face + 1] - begin;
    return {small ? small + begin : nullptr, large ? large + begin : nullptr, size};
  }
};

}  // namespace vorpipe::space
