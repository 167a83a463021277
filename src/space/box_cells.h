/// The cells of sites in a box.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "vorpipe/result.h"
#include "vorpipe/space.h"

namespace vorpipe::space {

/// For a run among whose sites some are left out.
struct LeftOut {
  std::array<bool, 3> axes;  ///< along which none is known beyond the domain
  std::size_t wanted;        ///< of how many sites, the first, measures are wanted
  /// By site, of one with a cell: how far the cell's empty balls reach beyond the domain; negative if they
  /// lie within.
  std::vector<double> beyond{};
};

/// The diagram of sites in the options' domain, without periods. Input is valid. Errors: as certify() and
/// writeDiagram().
Result<Diagram3> boxCells(std::span<const Point3> sites, const Cells3Options& options, int threads,
                          LeftOut* left_out = nullptr);

}  // namespace vorpipe::space
