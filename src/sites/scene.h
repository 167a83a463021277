/// The sites that a diagram or a picture of a domain is made from, whether it is periodic or not.
#pragma once

#include <span>

#include "sites/images.h"

namespace vorpipe::core {

struct Scene {
  ImagedSites imaged;  ///< `sites` is empty if the domain is not periodic: the caller's sites are then used
  Box clip{};          ///< what cells are clipped to
  Box picture{};       ///< the domain, in the same units

  [[nodiscard]] const Sites& sitesOr(const Sites& callers) const {
    return imaged.sites.size() == 0 ? callers : imaged.sites;
  }
  /// The caller's site that entry i is, or is an image of.
  [[nodiscard]] std::uint32_t siteOf(std::uint32_t i) const { return imaged.siteOf(i); }
};

/// The scene of a picture without cells. Errors: as placeSites'.
Result<Scene> sceneOf(const Sites& sites, const RenderOptions& options, int threads);

/// The scene of a domain that is not periodic.
Scene plainScene(const Sites& sites, const Box& domain);

/// Maps ids of images to their sites.
void nameSites(const Scene& scene, std::span<std::uint32_t> ids);

}  // namespace vorpipe::core
