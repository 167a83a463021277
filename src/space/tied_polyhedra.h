/// What a contraction leaves of cells, as parts of polyhedra.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "space/certified_cells.h"
#include "space/contraction.h"

namespace vorpipe::space {

/// The part of Polyhedra that is about the cells of a contraction. Vertices that only some of their cells
/// have in it are at the border: nothing happened to them. They may be numbered by other cells.
class TiedPolyhedra {
 public:
  TiedPolyhedra(const ProvedCells& cells, Contraction& contraction, int threads, Diagram3& diagram)
      : cells_(cells), contraction_(contraction), threads_(threads), out_(diagram) {}

  // In this order:
  /// Writes the size of all rings of each cell where its first ring's offset will be.
  void countRings() const;
  /// Writes rings, and their offsets from where those of the cell begin. Vertices are those of the
  /// contraction until writePlaces().
  void writeRings();
  /// Counts the vertices that each of these cells is to number: the first of all of their cells.
  void rankVertices(std::vector<std::uint32_t>& count);
  /// Numbers them, by how many the cells before have numbered.
  void addFirst(const std::vector<std::uint32_t>& first);
  /// The number of a vertex at the border, by the place of a cell in the contraction.
  void setNumber(std::size_t cell, std::size_t edge_end, std::uint32_t number) {
    number_[contraction_.vertices().at(cell, edge_end)] = number;
  }
  [[nodiscard]] std::uint32_t numberAt(std::size_t cell, std::size_t edge_end) const {
    return number_[contraction_.vertices().at(cell, edge_end)];
  }
  /// Moves the offsets of vertices' sites, which are four of each where nothing happened.
  void countSites();
  void writeSites();
  void findPlaces();
  /// Needs no more rows, and none of the contraction's rings.
  void writePlaces();

 private:
  struct Border;
  template <class Each>
  void forCells(const Each& each) const;
  template <class Each>
  void forInnerVisits(const Each& each) const;
  template <class Each>
  void forOwnVertices(const Each& each) const;
  void writeBorderSites();
  [[nodiscard]] bool isInner(std::size_t vertex) const;

  const ProvedCells& cells_;
  Contraction& contraction_;
  int threads_;
  Diagram3& out_;
  // By vertex of the contraction:
  BigVector<std::uint32_t> user_;    ///< the first cell that has it, then how many cells
  BigVector<std::uint32_t> number_;  ///< in the diagram, or none
  BigVector<std::uint8_t> around_;   ///< the walls that have faces at it, and whether it is at the border
  std::vector<std::vector<std::pair<std::uint32_t, Point3>>> place_;  ///< of vertices of the diagram
};

/// Writes the four sites and walls of a vertex of a row, ascending. No site comes before the cell's.
void writeSitesOf(const ProvedCells& cells, std::size_t site, const Row& row,
                  const std::array<std::uint32_t, 3>& faces, std::int64_t* to);

}  // namespace vorpipe::space
