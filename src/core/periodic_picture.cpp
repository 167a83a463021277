#include "core/periodic_picture.h"

#include <algorithm>

#include "core/periodic_band.h"

namespace vorpipe {
namespace {

bool areEqual(const std::vector<double>& weight) {
  return std::ranges::all_of(weight, [&](double each) { return each == weight.front(); });
}

}  // namespace

Result<Scene> sceneOf(const Sites& sites, const RenderOptions& options, int threads) {
  if (options.periodic == Periodic::none) {
    return Scene{{}, sites.size(), {}, options.domain, options.domain};
  }
  if (!options.outline.empty()) {
    return tl::unexpected(Error{ErrorCode::input, "a domain with an outline cannot be periodic"});
  }
  auto placed = placeSites(sites, options.domain, options.periodic, threads);
  if (!placed) return tl::unexpected(placed.error());
  auto imaged = withImages(*placed, bandForPlaces(*placed, threads));
  const Box picture = placed->domain();
  // Beyond the picture cells may be too large. Where every site has a cell, none is needed to tell which
  // sites have one, and a device finds cells in the domain faster.
  const bool all_have_cells = placed->all_inside && areEqual(sites.weight);
  const Box clip = all_have_cells ? imaged.box : picture;
  return Scene{std::move(imaged.sites), imaged.count, std::move(imaged.images), clip, picture};
}

void nameSites(const Scene& scene, std::span<std::uint32_t> ids) {
  if (scene.images.empty()) return;
  for (auto& id : ids) {
    if (id != no_site) id = scene.siteOf(id);
  }
}

}  // namespace vorpipe
