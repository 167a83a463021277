/// The sites of a run in space, and their domain.
#pragma once

#include <string>
#include <vector>

#include "cli/input.h"
#include "io/base/attribute.h"
#include "vorpipe.h"

namespace vorpipe::cli {

struct SpaceInput {
  Sites3 sites;
  Box3 domain{};
  /// The rest of what a run notes about its input; it has no sites in the plane, but the weights.
  Input common{};

  [[nodiscard]] const std::vector<double>& weights() const { return common.sites.weight; }
};

/// Loads or generates the sites of --sites and their weights, and finds the domain. Errors, after the
/// option's name: those of loadSpaceSites and takeWeights; the sites leave no domain.
Result<SpaceInput> loadSpaceInput(const InputOptions& options);

}  // namespace vorpipe::cli
