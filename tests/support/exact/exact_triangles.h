/// The triangles of a diagram, Delaunay or with weights regular, by exact predicates.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/exact/exact_cells.h"

namespace vorpipe::test {

struct TriangleFaults {
  std::uint64_t turned = 0;       ///< not counter-clockwise, or of duplicates or hidden sites
  std::uint64_t overlapping = 0;  ///< on the same side of an edge as another one
  std::uint64_t not_local = 0;    ///< an edge that would have to be flipped, and by more than a tie
  std::uint64_t missing = 0;      ///< corners of cells inside the domain that have no triangle; a wrong count
  std::vector<std::string> first;
  [[nodiscard]] bool none() const { return turned + overlapping + not_local + missing == 0; }
};

/// Looks for faults in a diagram with Detail::everything. It has the triangles of all sites that are not
/// hidden, whatever the domain; `exact` are the cells of the same sites.
TriangleFaults findTriangleFaults(const Diagram& diagram, const Sites& sites, const Box& domain,
                                  const ExactCells& exact);

}  // namespace vorpipe::test
