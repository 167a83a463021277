/// From cells that are proved to what is shown: a Diagram3.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "space/contraction.h"
#include "space/label.h"
#include "space/measures.h"
#include "space/rows.h"
#include "vorpipe/result.h"
#include "vorpipe/space.h"

namespace vorpipe::space {

/// What is known about the cells of a run.
struct ProvedCells {
  // By site of the run. Its coordinates times `unit`, a power of two, are the caller's.
  Places places;
  double unit;
  const Rows& rows;                      ///< certified: closed, glued to one another
  std::span<const std::uint32_t> input;  ///< the caller's index
  /// Those whose cells may have ties, ascending: all of those with an edge that is short.
  std::span<const std::uint32_t> tied;
  /// Of cells without `careful`. Areas are by face.
  std::span<const CellMeasures> measures;
  std::span<const std::vector<double>> face_areas;
  /// Those whose cells are not measured yet, ascending.
  std::span<const std::uint32_t> careful;

  // By the caller's index.
  std::span<const Point3> sites;
  std::span<const Status> status;  ///< ok: the site is in the run, and its row is not empty
  std::span<const std::uint32_t> owner;

  /// By site of the run, second moments of cells without `careful`. None: they are computed where they are
  /// wanted.
  std::span<const std::array<double, 6>> moments{};
};

/// Writes all but the report of a diagram, in the caller's order. Its numbers of vertices do not depend on
/// the order of the run or on the number of threads. Errors (device): faults of vorpipe.
Result<TieCounts> writeDiagram(const ProvedCells& cells, Detail3 detail, int threads, Diagram3& diagram);

}  // namespace vorpipe::space
