/// Cells as polyhedra: rings of vertices, each of which stands once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "space/certified_cells.h"
#include "space/contraction.h"
#include "space/label.h"

namespace vorpipe::space {

/// The faces of a cell that remain, in the order of their neighbors.
class FaceOrder {
 public:
  struct Face {
    std::int64_t neighbor;  ///< as the caller names it
    std::uint32_t face;     ///< of the row
  };
  FaceOrder(const ProvedCells& cells, const Contraction& contraction)
      : cells_(cells), contraction_(contraction) {}

  void take(Label site, const Row& row);
  /// Those that remain, ascending.
  [[nodiscard]] std::span<const Face> faces() const { return faces_; }
  /// Where the ring of a face of the row is begun: at the vertex after its edge to the least neighbor.
  [[nodiscard]] std::size_t beginOf(const Row& row, std::size_t face);

 private:
  const ProvedCells& cells_;
  const Contraction& contraction_;
  std::vector<Face> faces_, all_;
  std::vector<std::uint32_t> rank_;
};

/// Writes the polyhedra of a diagram whose faces are counted and written. `contraction` has all cells.
class Polyhedra {
 public:
  Polyhedra(const ProvedCells& cells, Contraction& contraction, int threads, Diagram3& diagram)
      : cells_(cells), contraction_(contraction), threads_(threads), out_(diagram) {}
  void write();

 private:
  struct Clusters;
  void writeRings();
  void numberVertices();
  void writePlaces();
  void findBest(Clusters& clusters);
  void placeVertices(const Clusters& clusters);
  void writeSites();
  template <class Each>
  void forOwnVertices(const Each& each);

  const ProvedCells& cells_;
  Contraction& contraction_;
  int threads_;
  Diagram3& out_;
  BigVector<std::uint32_t> user_;    ///< by vertex of the contraction: the first cell that has it
  BigVector<std::uint32_t> number_;  ///< the vertex of the diagram, or none
};

/// A wall or site of the run as the caller names it.
inline std::int64_t publicNumber(const ProvedCells& cells, Label label) {
  constexpr std::int64_t wall[walls] = {wall_xmin, wall_xmax, wall_ymin, wall_ymax, wall_zmin, wall_zmax};
  return isWallLabel(label) ? wall[wallOf(label)]
                            : std::int64_t{cells.input[static_cast<std::size_t>(label)]};
}

}  // namespace vorpipe::space
