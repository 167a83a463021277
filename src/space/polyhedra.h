/// Cells as polyhedra: rings of vertices, each of which stands once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/big_vector.h"
#include "space/certified_cells.h"
#include "space/contraction.h"
#include "space/label.h"
#include "space/row_vertices.h"
#include "space/tied_polyhedra.h"
#include "vorpipe/result.h"

namespace vorpipe::space {

/// Writes the polyhedra of a diagram whose faces are counted and written. Vertices are numbered in the order
/// in which the rings first name them: each by the first of its cells. Most cells are as their rows are, and
/// their vertices have four sites or walls; the others are left to TiedPolyhedra.
class Polyhedra {
 public:
  Polyhedra(const ProvedCells& cells, Contraction& contraction, int threads, Diagram3& diagram)
      : cells_(cells),
        contraction_(contraction),
        tied_(cells, contraction, threads, diagram),
        threads_(threads),
        out_(diagram) {}
  /// Rows and the contraction lose what is not needed any more. Error: two rows are not glued, a fault of who
  /// proved them.
  Result<void> write();

 private:
  /// The faces of a row towards cells that come before its own, which follow its walls.
  struct Earlier {
    std::size_t begin = 0, end = 0;
    [[nodiscard]] bool has(std::size_t face) const { return face - begin < end - begin; }
    /// Whether none of a vertex' faces is.
    [[nodiscard]] bool hasNone(const std::array<std::uint32_t, 3>& faces) const {
      return !has(faces[0]) && !has(faces[1]) && !has(faces[2]);
    }
  };
  [[nodiscard]] Earlier earlierFaces(std::size_t site, const Row& row) const;

  void layOutRings();
  void countVertices();
  void layOutEnds();
  void numberEnds();
  void numberForTied(std::size_t site, const Row& row, const std::array<std::uint32_t, 3>& faces,
                     std::uint32_t number);
  bool writeRings();
  bool takeOthers(std::size_t site, const Row& row, const Earlier& earlier, const RowVertices& vertices,
                  std::vector<std::uint32_t>& number) const;
  [[nodiscard]] std::uint32_t numberAt(std::size_t site, std::size_t edge_end) const;
  void writeSites();
  void writePlaces();
  template <class Each>
  void forPlainCells(const Each& each) const;
  [[nodiscard]] bool isTied(Label site) const { return contraction_.cellOf(site) != SharedVertices::nowhere; }

  const ProvedCells& cells_;
  Contraction& contraction_;
  TiedPolyhedra tied_;
  int threads_;
  Diagram3& out_;
  std::vector<std::uint32_t> first_;  ///< by the caller's index: the vertices numbered before
  static constexpr std::uint64_t is_large = std::uint64_t{1} << 63;
  static constexpr std::uint8_t not_own = 255;
  BigVector<std::uint64_t> ends_begin_;  ///< by site: in small_ or large_
  /// By edge end: which of the cell's own vertices it is, or that it is none; of cells with few vertices.
  BigVector<std::uint8_t> small_;
  BigVector<std::uint32_t> large_;
};

/// A wall or site of the run as the caller names it.
inline std::int64_t publicNumber(const ProvedCells& cells, Label label) {
  constexpr std::int64_t wall[walls] = {wall_xmin, wall_xmax, wall_ymin, wall_ymax, wall_zmin, wall_zmax};
  return isWallLabel(label) ? wall[wallOf(label)]
                            : std::int64_t{cells.input[static_cast<std::size_t>(label)]};
}

}  // namespace vorpipe::space
