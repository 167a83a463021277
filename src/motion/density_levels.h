/// Masses under a density that is far from even, by way of densities that are less so.
#pragma once

#include <vector>

#include "motion/prescribed_cells.h"
#include "vorpipe.h"

namespace vorpipe::moving {

/// Where Newton's method got to.
struct ReachedWeights {
  TransportEnd end = TransportEnd::converged;
  std::vector<TransportStep> trace{};  ///< of all densities
  PrescribedCells cells;               ///< as its solve() left them under `options`
};

/// Finds the weights of `sites` for these masses, as PrescribedCells::solve does. Where the density leaves
/// large parts of the domain next to empty, Newton steps are cut short there by cells that would lose their
/// mass. So where the density itself has not led anywhere after some diagrams, parts of its mean are added to
/// it, ten times less each time, and each level begins with the weights of the one before (decision D118).
Result<ReachedWeights> reachWeights(Session& session, const CellsOptions& options, Surface surface,
                                    const std::vector<double>& masses, Sites& sites,
                                    const PrescribedLimits& limits, const TransportWatcher& watcher);

}  // namespace vorpipe::moving
