/// Cells as combinatorics alone: faces, and the faces around each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "base/big_vector.h"
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

/// Memory in blocks, for several threads, which is given back at once.
class BlockPool {
 public:
  static constexpr std::size_t block = std::size_t{1} << 16;
  /// What is expected lies in one piece, so that it can be used again in one piece.
  explicit BlockPool(std::size_t expected) : region_(expected) {}
  /// A block, or more if so many bytes are needed.
  std::span<std::byte> take(std::size_t bytes);

 private:
  std::mutex mutex_;
  BigVector<std::byte> region_;
  std::size_t used_ = 0;
  std::vector<std::unique_ptr<std::byte[]>> others_;
};

/// Where one thread writes rows.
class RowArena {
 public:
  /// Bytes that are aligned for 8, out of `left` or a new block of the pool.
  static std::byte* get(std::span<std::byte>& left, std::size_t bytes, BlockPool& pool);

 private:
  friend class Rows;
  std::span<std::byte> neighbors_, rings_;
};

/// Rows of all sites of a run.
class Rows {
 public:
  /// Faces are kept in the order of their neighbors as the caller numbers them: walls first, zmax before
  /// xmin, then sites by `input`. Without it, by their own index.
  explicit Rows(std::size_t sites, std::span<const std::uint32_t> input = {});
  [[nodiscard]] std::size_t size() const { return at_.size(); }
  [[nodiscard]] Row operator[](std::size_t site) const;
  void prefetch(std::size_t site) const {
    prefetchLines(at_[site].neighbors);
    prefetchLines(at_[site].rings);
  }
  /// The face of a neighbor, or row.faces if it is none: the same as row.faceOf(), also quick for many faces.
  [[nodiscard]] std::size_t faceOf(const Row& row, Label label) const;
  void clear(std::size_t site) { at_[site] = {}; }
  /// Rows have no rings from then on.
  void forgetRings() { ring_pool_.reset(); }
  /// There are no rows from then on.
  void forget() {
    at_ = {};
    ring_pool_.reset();
    neighbor_pool_.reset();
  }

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
  /// A header and the neighbors; where rings begin, and the rings.
  struct At {
    std::byte *neighbors = nullptr, *rings = nullptr;
  };
  /// The first two lines of the cache from an address on, which may be null.
  static void prefetchLines(const std::byte* first) {
    constexpr std::uintptr_t line = 64;
    __builtin_prefetch(first);
    __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(first) + line));
  }
  template <bool from_least, class Vertex>
  bool setSmall(std::size_t site, std::span<const Label> neighbors, const Vertex* vertices,
                std::size_t vertex_count, RowArena& arena);
  template <class Number, class Entry, class Write>
  bool write(std::size_t site, std::uint32_t faces, std::size_t vertices, RowArena& arena,
             const Write& write);
  /// By which faces are ordered.
  [[nodiscard]] std::int32_t keyOf(Label label) const {
    return isWallLabel(label) || input_.empty()
               ? label
               : static_cast<std::int32_t>(input_[static_cast<std::size_t>(label)]);
  }

  std::span<const std::uint32_t> input_;
  std::vector<At> at_;
  std::unique_ptr<BlockPool> neighbor_pool_, ring_pool_;
};

}  // namespace vorpipe::space
