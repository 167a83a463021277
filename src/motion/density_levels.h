/// Prescribed masses under a very uneven density, by way of more even densities.
#pragma once

#include <vector>

#include "motion/prescribed_cells.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// The state that Newton's method reached.
struct ReachedWeights {
  TransportEnd end = TransportEnd::converged;
  std::vector<TransportStep> trace{};  ///< of all densities
  PrescribedCells cells;               ///< as its solve() left them under `options`
};

/// Finds the weights of `sites` for these masses, as PrescribedCells::solve does. If the density is almost 0
/// in large parts of the domain, cells there would lose their mass and force short Newton steps. So if there
/// is no progress after some diagrams, this adds parts of the density's mean to it, ten times less at each
/// level. Each level begins with the weights of the one before (decision D118).
Result<ReachedWeights> reachWeights(Session& session, const CellsOptions& options, Surface surface,
                                    const std::vector<double>& masses, Sites& sites,
                                    const PrescribedLimits& limits, const TransportWatcher& watcher);

}  // namespace vorpipe::moving
