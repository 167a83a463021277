// The promises of pictures of the globe.
#include <fmt/core.h>

#include <algorithm>

#include "check/checks.h"
#include "check/globe_sites.h"

namespace vorpipe::core::checks {
namespace {

constexpr std::uint64_t sampled_of_globe = std::uint64_t{1} << 22;

/// What is wrong with the site of a pixel, if anything; `slack` in radians.
std::string wrongAt(const GlobeSites& sites, const Rendering& rendering, std::uint32_t id,
                    const std::optional<SpaceVector>& place, double slack) {
  if (!place) return id == no_site ? "" : fmt::format("lies beside the map, and belongs to site {}", id);
  if (id >= sites.size() || rendering.status[id] != Status::ok) {
    return fmt::format("belongs to {}",
                       id == no_site ? "no site" : fmt::format("site {}, which has no cell", id));
  }
  const std::uint32_t nearest = rendering.owner[sites.nearestTo(*place)];
  const double beyond = sites.beyond(id, nearest, *place);
  if (beyond <= slack) return {};
  return fmt::format("belongs to site {}, but site {} is nearer by {:.4g} radians", id, nearest, beyond);
}

}  // namespace

std::vector<std::string> brokenInGlobePicture(const Sites& sites, const RenderOptions& options,
                                              const Rendering& rendering, int threads) {
  Broken broken;
  const Image& image = rendering.image;
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  if (image.width != options.width || image.height != options.height || image.ids.size() != pixels ||
      image.rgba.size() != pixels || rendering.status.size() != sites.size() ||
      rendering.owner.size() != sites.size()) {
    broken.add("pixels", fmt::format("there are {} ids and {} colors for {}x{}", image.ids.size(),
                                     image.rgba.size(), options.width, options.height));
    return broken.take();
  }
  const GlobeSites placed(sites);
  const GlobePixels places(options);
  const GlobeOutline outline(options.outline);
  // Places and sites are rounded; a border that turns about a near neighbor moves by more.
  constexpr double slack = 1e-9;
  const std::uint64_t every = (pixels + sampled_of_globe - 1) / sampled_of_globe;
  broken.expect("pixels", pixels, threadCount(threads), [&](std::size_t pixel) -> std::string {
    if ((pixel * 0x9E3779B97F4A7C15u >> 32) % every != 0) return {};
    const auto width = static_cast<std::size_t>(image.width);
    const int row = static_cast<int>(pixel / width), column = static_cast<int>(pixel % width);
    const PictureFrame& frame = places.frame();
    const int down = row - frame.top, right = column - frame.left;
    const bool inside = down >= 0 && down < frame.height && right >= 0 && right < frame.width;
    if (inside && places.isOnBorder(down, right)) return {};
    auto place = inside ? places.at(down, right) : std::nullopt;
    if (place && !options.outline.empty()) {
      const auto side = outline.at(*place);
      if (side == GlobeOutline::Side::edge) return {};
      if (side == GlobeOutline::Side::outside) place.reset();
    }
    const std::string wrong = wrongAt(placed, rendering, image.ids[pixel], place, slack);
    return wrong.empty() ? "" : fmt::format("row {}, column {} {}", row, column, wrong);
  });
  return broken.take();
}

}  // namespace vorpipe::core::checks
