/// Names of backends and what they open; what "auto" and "vulkan" mean.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backend/backend.h"
#include "backend/exact_tier.h"

namespace vorpipe {

struct OpenedBackend {
  std::unique_ptr<Backend> backend;
  std::string choice;  ///< why this one, if the name left a choice
  /// Names of the backends to try next for the same requested name, if this one fails during work.
  std::vector<std::string> others{};
  bool beside_drivers = false;  ///< as in DeviceInfo
};

/// Opens `options.name`: a registry name (vulkan-geometry, vulkan-compute, opengl, cpu), "vulkan"
/// (vulkan-compute, or vulkan-geometry where only that can run) or "auto" (a hardware device through Vulkan,
/// then through OpenGL; without one cpu, or, if a device is named or masked, Vulkan's software driver, then
/// OpenGL's). Errors: an unknown name (input); no such device (device).
Result<OpenedBackend> openBackend(const BackendOptions& options);

/// Returns the exact tier, which finds the cells that a device leaves.
std::unique_ptr<ExactTier> openExactTier(int threads);

/// Returns the search for the site nearest to a place. `sites` must outlive it.
std::unique_ptr<PlaceSearch> openPlaceSearch(const SiteSet& sites, int threads);

}  // namespace vorpipe
