#include "view/swatches.h"

#include <cstddef>

#include "vorpipe/cells.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {
namespace {

std::vector<Swatch> makeSwatches() {
  // Sites with evenly spaced weights get the colors of the whole map, in its order.
  Sites sites;
  for (int i = 0; i < 17; ++i) {
    sites.x.push_back(i);
    sites.y.push_back(0);
    sites.weight.push_back(i);
  }
  std::vector<Swatch> result;
  for (const std::string& name : colormaps()) {
    RenderOptions options{};
    options.domain = {0, 0, 1, 1};
    options.width = options.height = 1;
    options.color = ColorBy::weight;
    options.color_scale = ColorScale::linear;
    options.colormap = name;
    const Result<SiteColors> colors = siteColors(sites, Diagram{}, options);
    // Every listed map has colors; one without would still be listed by name.
    result.push_back({name, colors ? colors->rgba : std::vector<ImU32>{}});
  }
  return result;
}

}  // namespace

const std::vector<Swatch>& swatches() {
  static const std::vector<Swatch> made = makeSwatches();
  return made;
}

void drawSwatch(std::span<const ImU32> colors, ImVec2 from, ImVec2 to) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto parts = static_cast<float>(colors.size()) - 1;
  for (std::size_t i = 0; i + 1 < colors.size(); ++i) {
    const float left = from.x + (to.x - from.x) * static_cast<float>(i) / parts;
    const float right = from.x + (to.x - from.x) * static_cast<float>(i + 1) / parts;
    list.AddRectFilledMultiColor({left, from.y}, {right, to.y}, colors[i], colors[i + 1], colors[i + 1],
                                 colors[i]);
  }
}

}  // namespace vorpipe::view
