#include <array>
#include <string>

#include <fmt/format.h>

#include "view/groups.h"
#include "view/style.h"
#include "view/swatches.h"

namespace vorpipe::view {
namespace {

// In the order of their enumerations.
const std::array<std::string, 4> color_choices{"site", "area", "neighbors", "weight"};
const std::array<std::string, 3> flow_names{"off", "density", "speed"};
const std::array<std::string, 4> scale_choices{"auto", "linear", "log", "quantile"};

void drawMaps(Widgets& widgets, RenderOptions& picture) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  const float pad = widgets.px(4), bar = widgets.px(70);
  // The closed list shows a color bar, with the map's name to its right.
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool open = widgets.beginList("Colormap", "");
  list.AddText({at.x + bar + 3 * pad, at.y + ImGui::GetStyle().FramePadding.y}, look::text,
               picture.colormap.c_str());
  if (open) {
    for (const Swatch& swatch : swatches()) {
      const ImVec2 from = ImGui::GetCursorScreenPos();
      const std::string name = fmt::format("Colormap/{}", swatch.name);
      if (widgets.item(name, "", swatch.name == picture.colormap)) picture.colormap = swatch.name;
      const float line = ImGui::GetTextLineHeight();
      drawSwatch(swatch.colors, {from.x, from.y + 1}, {from.x + bar, from.y + line - 1});
      ImGui::GetWindowDrawList()->AddText({from.x + bar + 2 * pad, from.y}, look::text, swatch.name.c_str());
    }
    widgets.endList();
  }
  for (const Swatch& swatch : swatches()) {
    if (swatch.name != picture.colormap) continue;
    drawSwatch(swatch.colors, {at.x + pad, at.y + pad}, {at.x + pad + bar, at.y + height - pad});
  }
}

/// Like the keys: if the colors get another meaning, resets their range and scale; colors by site have no
/// legend.
void colorBy(ColorBy color, RenderOptions& picture) {
  if (color == picture.color) return;
  picture.color = color;
  picture.color_scale = ColorScale::automatic;
  picture.color_range.reset();
  if (color == ColorBy::site) picture.legend = false;
}

}  // namespace

void drawColor(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  RenderOptions& picture = frame.answer.settings.picture;
  if (!widgets.group("Color")) return;
  FlowColor& flow = frame.answer.settings.flow_color;
  const bool by_flow = frame.input.fluid && flow != FlowColor::none;
  const int color = widgets.choice("Color", color_choices, by_flow ? -1 : static_cast<int>(picture.color));
  if (color >= 0) {
    colorBy(static_cast<ColorBy>(color), picture);
    flow = FlowColor::none;
  }
  if (frame.input.fluid) {
    widgets.row("Fluid");
    const int by = widgets.choice("Flow", flow_names, static_cast<int>(flow));
    if (by >= 0) flow = static_cast<FlowColor>(by);
    widgets.tooltip("Colors by what flows, in place of those above");
  }
  const bool by_site = picture.color == ColorBy::site && !by_flow;
  widgets.row("Scale");
  const int scale = widgets.choice("Scale", scale_choices, static_cast<int>(picture.color_scale), !by_site);
  if (scale >= 0) picture.color_scale = static_cast<ColorScale>(scale);
  widgets.row("Colors");
  drawMaps(widgets, picture);
}

}  // namespace vorpipe::view
