/// From cells that are proved to what is shown: a Diagram3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "space/contraction.h"
#include "space/label.h"
#include "space/records.h"
#include "space/rows.h"
#include "vorpipe/result.h"
#include "vorpipe/space.h"

namespace vorpipe::space {

/// What is known about the cells of a run.
struct ProvedCells {
  // By site of the run. Its coordinates times `unit`, a power of two, are the caller's.
  Places places;
  double unit;
  Rows& rows;                            ///< certified: closed, glued to one another
  std::span<const std::uint32_t> input;  ///< the caller's index
  /// Those whose cells may have ties, ascending: all of those with an edge that is short.
  std::span<const std::uint32_t> tied;
  /// Those without records, ascending.
  std::span<const std::uint32_t> unmeasured;

  // By the caller's index.
  std::span<const Point3> sites;
  std::span<const Status> status;  ///< ok: the site is in the run, and its row is not empty
  std::span<const std::uint32_t> owner;
};

/// Writes all but the report of a diagram, in the caller's order. `records` have been written of all cells
/// but those that are unmeasured, with room for the areas of each row. If only measures are wanted, rows lose
/// their rings. Its numbers of vertices do not depend on the order of the run or on the number of threads.
/// Errors (device): faults of vorpipe.
Result<TieCounts> writeDiagram(const ProvedCells& cells, Records& records, Detail3 detail, int threads,
                               Diagram3& diagram);

}  // namespace vorpipe::space
