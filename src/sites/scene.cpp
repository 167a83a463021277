#include "sites/scene.h"

#include "sites/band.h"

namespace vorpipe::core {

Scene plainScene(const Sites& sites, const Box& domain) {
  Scene scene{{}, domain, domain};
  scene.imaged.count = sites.size();
  return scene;
}

Result<Scene> sceneOf(const Sites& sites, const RenderOptions& options, int threads) {
  if (options.periodic == Periodic::none) return plainScene(sites, options.domain);
  auto placed = placeSites(sites, options.domain, options.periodic, threads);
  if (!placed) return tl::unexpected(placed.error());
  auto imaged = withImages(*placed, bandForPlaces(*placed, threads));
  const Box picture = placed->domain();
  // A device finds cells clipped to the domain faster. But cells clipped to more than the picture do not show
  // which sites have a cell in it, unless every site does.
  const Box clip = placed->all_inside ? imaged.box : picture;
  return Scene{std::move(imaged), clip, picture};
}

void nameSites(const Scene& scene, std::span<std::uint32_t> ids) {
  if (scene.imaged.images.empty()) return;
  for (auto& id : ids) {
    if (id != no_site) id = scene.siteOf(id);
  }
}

}  // namespace vorpipe::core
