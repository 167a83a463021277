#include "core/periodic/scene.h"

#include "core/periodic/band.h"
#include "core/sites/weights.h"

namespace vorpipe::core {
Result<Scene> sceneOf(const Sites& sites, const RenderOptions& options, int threads) {
  if (options.periodic == Periodic::none) {
    return Scene{{}, sites.size(), {}, options.domain, options.domain};
  }
  auto placed = placeSites(sites, options.domain, options.periodic, threads);
  if (!placed) return tl::unexpected(placed.error());
  auto imaged = withImages(*placed, bandForPlaces(*placed, threads));
  const Box picture = placed->domain();
  // A device finds cells in the domain faster. But beyond the picture cells may be too large: they do not
  // tell whether a site has one, unless every site does, or weights have others asked.
  const bool may_be_larger = placed->all_inside || hasWeights(sites);
  const Box clip = may_be_larger ? imaged.box : picture;
  return Scene{std::move(imaged.sites), imaged.count, std::move(imaged.images), clip, picture};
}

void nameSites(const Scene& scene, std::span<std::uint32_t> ids) {
  if (scene.images.empty()) return;
  for (auto& id : ids) {
    if (id != no_site) id = scene.siteOf(id);
  }
}

}  // namespace vorpipe::core
