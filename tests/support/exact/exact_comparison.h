/// A diagram against the exact cells of the same sites.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/exact/exact_cells.h"

namespace vorpipe::test {

/// What is promised of a diagram.
struct Promise {
  double shortest = 1e-6;   ///< an edge's length by the distance of its sites, or by the domain's shorter
                            ///< side; longer ones are reported
  double gap = 1e-9;        ///< relative, about `shortest`: there, either is right
  double area = 1e-5;       ///< relative to the cell
  double mean_area = 1e-9;  ///< and this part of the mean cell
};

struct Comparison {
  std::uint64_t cells = 0;         ///< wrong status, owner, or cell_offsets
  std::uint64_t areas = 0;         ///< farther off than promised
  std::uint64_t missing = 0;       ///< neighbors that are not reported
  std::uint64_t invented = 0;      ///< neighbors that are reported and are none
  std::uint64_t one_sided = 0;     ///< neighbors that do not report the cell in turn
  std::uint64_t lengths = 0;       ///< of edges, where the diagram has them
  double worst_area = 0;           ///< the largest difference, as a part of what is promised
  std::vector<std::string> first;  ///< the first 10 faults, a line each
  [[nodiscard]] bool agree() const { return cells + areas + missing + invented + one_sided + lengths == 0; }
  /// The counts that are not 0, or "agrees".
  [[nodiscard]] std::string summary() const;
};

/// Walls are neighbors like others, at the distance of the mirrored site; but a tie may end at a wall,
/// and moves the corner there, so that a wall's edge near the limit may be reported or not.
Comparison compareWithExact(const Diagram& diagram, const Sites& sites, const Box& domain,
                            const ExactCells& exact, const Promise& promise = {});

}  // namespace vorpipe::test
