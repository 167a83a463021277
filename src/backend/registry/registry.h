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
  std::string choice;  ///< why this one, where the name left a choice
  /// The backends that the same name would take next, by their own names, if this one fails at work.
  std::vector<std::string> others{};
  bool beside_drivers = false;  ///< as in DeviceInfo
};

/// Opens `options.name`: a registry name (vulkan-geometry, vulkan-compute, opengl, cpu), "vulkan"
/// (vulkan-compute, or vulkan-geometry where only that can run) or "auto" (a hardware device through
/// Vulkan, then through OpenGL; without one cpu, but where a device is named or masked Vulkan's software
/// driver, then OpenGL's). Errors: an unknown name (input); no such device (device).
Result<OpenedBackend> openBackend(const BackendOptions& options);

/// What finds the cells that a device leaves.
std::unique_ptr<ExactTier> openExactTier(int threads);

/// What finds the site that is nearest to a place. `sites` outlive it.
std::unique_ptr<PlaceSearch> openPlaceSearch(const SiteSet& sites, int threads);

}  // namespace vorpipe
