/// Cells as combinatorics alone: faces, and the faces around each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "space/label.h"

namespace vorpipe::space {

/// A ring: the faces across the edges of a face, as indices into the row, counter-clockwise seen from
/// outside. Consecutive ones, r[k] and r[k + 1], meet in a vertex of the face.
class Ring {
 public:
  Ring(const std::uint8_t* small, const std::uint32_t* large, std::size_t size)
      : small_(small), large_(large), size_(size) {}
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t operator[](std::size_t k) const {
    return large_ != nullptr ? large_[k] : small_[k];
  }

 private:
  const std::uint8_t* small_;
  const std::uint32_t* large_;
  std::size_t size_;
};

/// The cell of one site. It has none if there are no faces.
struct Row {
  std::uint32_t faces = 0;
  std::uint32_t edge_ends = 0;  ///< the sum of all rings' sizes: twice the edges, three times the vertices
  const Label* neighbor = nullptr;  ///< by face
  // One of the two forms: where each ring begins, and one more; and the rings.
  const std::uint16_t* small_begin = nullptr;
  const std::uint8_t* small = nullptr;
  const std::uint32_t* large_begin = nullptr;
  const std::uint32_t* large = nullptr;

  [[nodiscard]] bool isSmall() const { return large == nullptr; }
  [[nodiscard]] std::size_t ringBegin(std::size_t face) const {
    return isSmall() ? small_begin[face] : large_begin[face];
  }
  [[nodiscard]] Ring ring(std::size_t face) const {
    const std::size_t begin = ringBegin(face), size = ringBegin(face + 1) - begin;
    return isSmall() ? Ring(small + begin, nullptr, size) : Ring(nullptr, large + begin, size);
  }
  [[nodiscard]] std::span<const Label> neighbors() const { return {neighbor, faces}; }
  /// The face of a neighbor, or `faces` if it is none.
  [[nodiscard]] std::size_t faceOf(Label label) const {
    std::size_t at = faces;
    for (std::size_t f = 0; f < faces; ++f) at = neighbor[f] == label ? f : at;
    return at;
  }
};

/// Memory for rows that are written by one thread at a time, and kept.
class RowArena {
 public:
  /// Bytes that are aligned for Label.
  std::byte* get(std::size_t bytes);

 private:
  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::size_t left_ = 0;
  std::byte* next_ = nullptr;
};

/// Rows of all sites of a run.
class Rows {
 public:
  explicit Rows(std::size_t sites) : at_(sites, nullptr) {}
  [[nodiscard]] std::size_t size() const { return at_.size(); }
  [[nodiscard]] Row operator[](std::size_t site) const;
  void prefetch(std::size_t site) const {
    __builtin_prefetch(at_[site]);
    __builtin_prefetch(at_[site] + 64);
    __builtin_prefetch(at_[site] + 128);
  }
  void clear(std::size_t site) { at_[site] = nullptr; }

  /// Sets the row of a site from its faces' neighbors and its vertices: three faces each, counter-clockwise
  /// seen from outside. Returns false, and clears the row, if they are no rings: one for each face, of three
  /// faces or more. Rings begin with their least face: whatever the order of vertices, the row is the same.
  bool set(std::size_t site, std::span<const Label> neighbors,
           std::span<const std::array<std::uint32_t, 3>> vertices, RowArena& arena);
  /// For 64 faces and vertices at most; a fourth number of each vertex is not used. Where rings begin depends
  /// on the order of vertices.
  bool set(std::size_t site, std::span<const Label> neighbors, const std::uint8_t (*vertices)[4],
           std::size_t vertex_count, RowArena& arena);

 private:
  template <bool from_least, class Vertex>
  bool setSmall(std::size_t site, std::span<const Label> neighbors, const Vertex* vertices,
                std::size_t vertex_count, RowArena& arena);
  std::vector<std::byte*> at_;
};

}  // namespace vorpipe::space
