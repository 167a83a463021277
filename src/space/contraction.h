/// From the certified complex, which is simple, to what is shown: the ends of ties become one vertex.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "space/cell_walk.h"
#include "space/label.h"
#include "space/rows.h"
#include "space/shared_vertices.h"
#include "vorpipe/result.h"

namespace vorpipe::space {

struct TieCounts {
  std::uint64_t edges = 0;  ///< edges whose ends became one
  std::uint64_t faces = 0;  ///< faces that are left with fewer than three vertices, in both of their cells
  std::uint64_t spurs = 0;  ///< rings that remain, and visited a vertex twice
  std::uint64_t straight =
      0;                    ///< vertices that were left between two edges around which the same cells stand
  std::uint64_t finer = 0;  ///< vertices that would have been too wide, or pinched a face: shorter ties there
  std::uint64_t flat = 0;   ///< cells with fewer than four faces
  std::uint64_t gone = 0;   ///< cells without faces
};

/// The contracted cells. An edge without length is always a tie. Then those edges that have come to lie
/// between the same two vertices, because a face between them vanished, are one; it is a tie if it is not
/// longer than 1e-6 of the least distance between any two of the sites around it. Where a vertex would become
/// wider than 4 ties of its radius, or a face would be pinched into two, ties are 64 times shorter.
class Contraction {
 public:
  /// Contracts the cells of sites that may have ties (ascending; all of those with a short edge), and all
  /// cells around them. Errors (device): faults of vorpipe.
  static Result<Contraction> of(const Places& places, const Rows& rows, std::span<const std::uint32_t> tied,
                                int threads);

  /// Those that may differ from their rows.
  [[nodiscard]] std::span<const Label> cells() const { return vertices_.cells(); }
  [[nodiscard]] std::uint32_t cellOf(Label site) const { return vertices_.cellOf(site); }
  [[nodiscard]] SharedVertices& vertices() { return vertices_; }
  /// The vertex that a vertex has become.
  [[nodiscard]] std::uint32_t become(std::uint32_t vertex) const { return sets_->root(vertex); }
  /// How many vertices of a face remain: 0 if it does not; many_vertices for that many or more.
  static constexpr std::uint8_t many_vertices = 255;
  [[nodiscard]] std::uint8_t remaining(std::size_t cell, std::size_t face) const {
    return remaining_[face_begin_[cell] + face];
  }
  /// For ring(), one for each thread.
  [[nodiscard]] CellWalk cellWalk() const { return CellWalk(vertices_, *sets_); }
  /// Makes ready a cell's rings.
  void take(std::size_t cell, const Row& row, CellWalk& walk) const {
    walk.take(cell, row, [this](std::uint32_t vertex) { return isDropped(vertex); });
  }
  /// The ring of a face that remains, begun as near to the k-th of its vertices as it does, in a cell that
  /// was taken. Steps lead to vertices.
  static const std::vector<RingStep>& ring(CellWalk& walk, const Row& row, std::size_t face, std::size_t k);
  [[nodiscard]] const TieCounts& counts() const { return counts_; }
  /// Frees what ring() and become() need.
  void forgetRings() {
    vertices_.forgetEnds();
    sets_.reset();
    marks_ = {};
    dropped_ = {};
  }

 private:
  explicit Contraction(SharedVertices vertices) : vertices_(std::move(vertices)) { startAgain(); }
  void startAgain();
  struct Walked;
  std::vector<std::uint32_t> findFaces(const Rows& rows, int threads);
  Walked walkFaces(const Rows& rows, int threads);
  void walkCell(std::size_t cell, const Row& row, CellWalk& walk, Walked& found);
  std::uint64_t dropStraight(int threads);
  [[nodiscard]] bool isDropped(std::uint32_t vertex) const {
    return !dropped_.empty() && dropped_[vertex] != 0;
  }

  SharedVertices vertices_;
  std::unique_ptr<DisjointSets> sets_;
  std::vector<std::uint64_t> face_begin_;  ///< by cell: in remaining_
  BigVector<std::uint8_t> remaining_;
  std::vector<std::uint8_t> dropped_;  ///< by vertex: 1 for those that are none; empty if there are no such
  BigVector<std::uint8_t> marks_;      ///< by vertex: see contraction.cpp
  TieCounts counts_;
};

}  // namespace vorpipe::space
