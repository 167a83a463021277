/// What a picture of a domain is drawn from, whether it is periodic or not.
#pragma once

#include <span>

#include "core/periodic/images.h"
#include "core/sites/site_set.h"

namespace vorpipe::core {

/// The sites to draw: the caller's, or these with images.
struct Scene : SiteImages {
  Sites sites;  ///< of the entries; empty where the domain is not periodic: then they are the caller's
  Box clip;     ///< what cells are clipped to
  Box picture;  ///< what is drawn

  [[nodiscard]] const Sites& sitesOr(const Sites& callers) const {
    return sites.size() == 0 ? callers : sites;
  }
};

/// Errors: as placeSites'.
Result<Scene> sceneOf(const Sites& sites, const RenderOptions& options, int threads);

/// Names images by their sites.
void nameSites(const Scene& scene, std::span<std::uint32_t> ids);

}  // namespace vorpipe::core
