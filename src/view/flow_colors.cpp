#include "view/flow_colors.h"

#include <cmath>
#include <utility>

namespace vorpipe::view {
namespace {

/// Multiplies two colors channel by channel; white leaves the other unchanged.
std::uint32_t through(std::uint32_t filter, std::uint32_t color) {
  constexpr std::uint32_t most = 255;
  std::uint32_t seen = color & 0xFF000000U;
  for (int shift = 0; shift < 24; shift += 8) {
    const std::uint32_t product = (filter >> shift & most) * (color >> shift & most);
    seen |= (product + most / 2) / most << shift;
  }
  return seen;
}

}  // namespace

RenderOptions ofWhiteCells(RenderOptions options) {
  options.color = ColorBy::site;
  options.color_scale = ColorScale::automatic;
  options.color_range.reset();
  options.legend = options.fill = false;
  return options;
}

Sites valuesOf(const FluidState& state, FlowColor by) {
  Sites values = state.sites;
  values.weight.assign(values.size(), 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (by == FlowColor::speed) {
      values.weight[i] = std::hypot(state.velocity[i].x, state.velocity[i].y);
    } else if (!state.density.empty()) {
      values.weight[i] = state.density[i];
    }
  }
  return values;
}

Result<void> colorFlow(const FluidState& state, FlowColor by, const RenderOptions& options, Image& image) {
  RenderOptions scaled = options;
  scaled.color = ColorBy::weight;
  if (scaled.color_scale == ColorScale::automatic) scaled.color_scale = ColorScale::linear;
  const auto colors = siteColors(valuesOf(state, by), {}, scaled);
  if (!colors) return tl::unexpected(colors.error());
  for (std::size_t at = 0; at < image.ids.size(); ++at) {
    if (image.ids[at] != no_site) image.rgba[at] = through(colors->rgba[image.ids[at]], image.rgba[at]);
  }
  return {};
}

}  // namespace vorpipe::view
