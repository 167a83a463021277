/// One number for each vertex of many cells, found by laying rings of glued faces on one another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "space/label.h"
#include "space/row_vertices.h"
#include "space/rows.h"
#include "vorpipe/result.h"

namespace vorpipe::space {

/// The vertices of some cells of a run, numbered from 0: by the least of their sites among these cells, then
/// as RowVertices does. Cells are named by their places in the list of them.
class SharedVertices {
 public:
  /// The vertices of the cells of these sites, in ascending order, which all have rows. Error: two rows are
  /// not glued, a fault of who proved them.
  static Result<SharedVertices> of(const Rows& rows, std::vector<Label> cells, int threads);

  [[nodiscard]] std::span<const Label> cells() const { return cells_; }
  /// The number of vertices.
  [[nodiscard]] std::size_t size() const { return own_begin_.back(); }
  /// The place of a site in the list of cells, or `nowhere`.
  static constexpr std::uint32_t nowhere = 0xffffffff;
  [[nodiscard]] std::uint32_t cellOf(Label site) const {
    if (cells_.empty()) return nowhere;
    return place_.empty() ? static_cast<std::uint32_t>(site) : place_[static_cast<std::size_t>(site)];
  }
  /// The vertex at an edge end of a cell; see RowVertices.
  [[nodiscard]] std::uint32_t at(std::size_t cell, std::size_t edge_end) const {
    return vertex_[vertex_begin_[cell] + vertexInCell(cell, edge_end)];
  }
  /// The vertices of a cell, as RowVertices numbers them.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cell) const {
    return std::span(vertex_).subspan(vertex_begin_[cell], vertex_begin_[cell + 1] - vertex_begin_[cell]);
  }
  /// Calls each(edge end, vertex) with the number of the vertex in the cell.
  template <class Each>
  void forEnds(std::size_t cell, std::size_t ends, const Each& each) const {
    const std::uint64_t begin = end_begin_[cell];
    if ((begin & is_large) != 0) {
      const auto* const large = large_.data() + (begin & ~is_large);
      for (std::size_t e = 0; e < ends; ++e) each(e, large[e]);
    } else {
      const auto* const small = small_.data() + begin;
      for (std::size_t e = 0; e < ends; ++e) each(e, small[e]);
    }
  }
  /// The first of the vertices that no other cell has numbered, whose numbers follow one another.
  [[nodiscard]] std::uint32_t ownBegin(std::size_t cell) const { return own_begin_[cell]; }
  [[nodiscard]] std::uint32_t ownEnd(std::size_t cell) const { return own_begin_[cell + 1]; }
  /// Whether a cell is the least of a vertex' cells: of the faces' neighbors no one comes before.
  [[nodiscard]] bool isOwn(Label site, const Row& row, const std::array<std::uint32_t, 3>& faces) const {
    for (const auto face : faces) {
      const Label label = row.neighbor[face];
      if (!isWallLabel(label) && label < site && cellOf(label) != nowhere) return false;
    }
    return true;
  }
  /// Frees all but ownBegin(), isOwn() and what these need.
  void forgetEnds();

 private:
  [[nodiscard]] std::uint32_t vertexInCell(std::size_t cell, std::size_t edge_end) const {
    const std::uint64_t begin = end_begin_[cell];
    return begin & is_large ? large_[(begin & ~is_large) + edge_end] : small_[begin + edge_end];
  }
  void layOut(const Rows& rows);
  void numberOwn(const Rows& rows, int threads);
  bool takeOthers(const Rows& rows, int threads);
  bool takeFrom(std::size_t cell, std::size_t face, const Row& row, const std::vector<Label>& earlier,
                const Rows& rows);
  void findEarlier(Label site, const Row& row, std::vector<Label>& earlier) const;

  static constexpr std::uint64_t is_large = std::uint64_t{1} << 63;
  std::vector<Label> cells_;
  std::vector<std::uint32_t> place_;         ///< by site; empty if all sites are cells
  std::vector<std::uint64_t> vertex_begin_;  ///< by cell: in vertex_
  std::vector<std::uint64_t> end_begin_;     ///< by cell: in small_ or large_
  std::vector<std::uint32_t> own_begin_;
  BigVector<std::uint32_t> vertex_;
  BigVector<std::uint8_t> small_;  ///< by edge end: the vertex in its cell, of cells of 256 vertices at most
  BigVector<std::uint32_t> large_;
};

}  // namespace vorpipe::space
