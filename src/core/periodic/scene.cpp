#include "core/periodic/scene.h"

#include "core/periodic/band.h"
#include "core/sites/weights.h"

namespace vorpipe::core {
Result<Scene> sceneOf(const Sites& sites, const RenderOptions& options, int threads) {
  if (options.periodic == Periodic::none) {
    return Scene{{sites.size(), {}}, {}, options.domain, options.domain};
  }
  auto placed = placeSites(sites, options.domain, options.periodic, threads);
  if (!placed) return tl::unexpected(placed.error());
  auto imaged = withImages(*placed, bandForPlaces(*placed, threads));
  const Box picture = placed->domain();
  // A device finds cells clipped to the domain faster. But cells clipped to more than the picture do not show
  // which sites have one in it; that must be known by other means: all have one, or cells were measured.
  const bool may_be_larger = placed->all_inside || hasWeights(sites);
  const Box clip = may_be_larger ? imaged.box : picture;
  return Scene{{imaged.count, std::move(imaged.images)}, std::move(imaged.sites), clip, picture};
}

void nameSites(const Scene& scene, std::span<std::uint32_t> ids) {
  if (scene.images.empty()) return;
  for (auto& id : ids) {
    if (id != no_site) id = scene.siteOf(id);
  }
}

}  // namespace vorpipe::core
