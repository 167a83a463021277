/// The whole way from sites to cells as data on one backend, where the domain is a box.
#pragma once

#include "core/sites/site_set.h"

namespace vorpipe::core {

struct BoxDiagram {
  Diagram diagram;
  std::vector<std::uint32_t> order;  ///< the sites that may have cells, neighbors near each other
  int exponent = 0;                  ///< what was computed is in units times 2^exponent
};

/// What Session::cells does, on an open backend, but for outlines, periods and mass; checkOptions found
/// nothing to refuse. Errors: those of prepare, which name the sites of `callers` if there are any; as
/// Session::cells'.
Result<BoxDiagram> boxDiagramOn(Backend& backend, Backend& judge_backend, int threads, const Sites& sites,
                                const CellsOptions& options, const CallersSites* callers = nullptr);

}  // namespace vorpipe::core
