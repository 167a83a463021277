// The panel's groups for the picture: actions, the cell under the pointer, marks and colors.
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "view/widgets.h"
#include "vorpipe/cells.h"
#include "vorpipe/picture.h"

namespace vorpipe::view {
namespace {

struct ActionButton {
  const char* name;
  const char* label;
  Action action;
  const char* tip;
  bool enabled = true;
};

/// Draws buttons that fill the rest of a row, with widths according to the lengths of their labels.
void drawButtons(PanelFrame& frame, std::span<const ActionButton> buttons) {
  const float gap = ImGui::GetStyle().ItemSpacing.x,
              right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  float asked = 0;
  for (const ActionButton& button : buttons) asked += ImGui::CalcTextSize(button.label).x + gap;
  const float more = (ImGui::GetContentRegionAvail().x + gap - asked) / static_cast<float>(buttons.size());
  for (const ActionButton& button : buttons) {
    const bool last = &button == &buttons.back();
    const float width = last ? right - ImGui::GetCursorPosX() : ImGui::CalcTextSize(button.label).x + more;
    if (frame.widgets.button(button.name, button.label, width, button.enabled)) {
      frame.result.actions.push_back(button.action);
    }
    frame.widgets.tooltip(button.tip);
    if (!last) ImGui::SameLine();
  }
}

void drawSizes(Widgets& widgets, RenderOptions& picture) {
  if (picture.edges) {
    widgets.slider("Edges", "Edge width", picture.edge_width, 1, 10, "%.1f px");
  }
  if (picture.show_sites) {
    widgets.slider("Sites", "Site size", picture.dot_size, 0, 30,
                   picture.dot_size > 0 ? "%.1f px" : "by their spacing");
  }
  if (picture.labels) {
    widgets.slider("Labels", "Label size", picture.label_size, 5, 40, "%.0f px");
  }
}

/// A color map and some of its colors, from the first to the last, R in the lowest byte.
struct Swatch {
  std::string name;
  std::vector<ImU32> colors;
};

/// The swatches of colormaps(), in its order.
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

/// Draws colors side by side, each shading into the next, from one corner to the opposite.
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

// In the order of their enumerations.
const std::array<std::string, 3> flow_names{"off", "density", "speed"};
const std::array<std::string, 4> scale_choices{"auto", "linear", "log", "quantile"};

void drawMaps(Widgets& widgets, RenderOptions& picture) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  const float pad = widgets.px(4), bar = widgets.px(70);
  static const std::vector<Swatch> swatches = makeSwatches();
  // The closed list shows a color bar, with the map's name to its right.
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool open = widgets.beginList("Colormap", "");
  list.AddText({at.x + bar + 3 * pad, at.y + ImGui::GetStyle().FramePadding.y}, look::text,
               colormapOf(picture).c_str());
  if (open) {
    for (const Swatch& swatch : swatches) {
      const ImVec2 from = ImGui::GetCursorScreenPos();
      const std::string name = fmt::format("Colormap/{}", swatch.name);
      if (widgets.item(name, "", swatch.name == colormapOf(picture))) picture.colormap = swatch.name;
      const float line = ImGui::GetTextLineHeight();
      drawSwatch(swatch.colors, {from.x, from.y + 1}, {from.x + bar, from.y + line - 1});
      ImGui::GetWindowDrawList()->AddText({from.x + bar + 2 * pad, from.y}, look::text, swatch.name.c_str());
    }
    widgets.endList();
  }
  for (const Swatch& swatch : swatches) {
    if (swatch.name != colormapOf(picture)) continue;
    drawSwatch(swatch.colors, {at.x + pad, at.y + pad}, {at.x + pad + bar, at.y + height - pad});
  }
}

}  // namespace

void drawActions(PanelFrame& frame) {
  const ActionButton first[] = {{"Undo", "Undo", Action::undo, "What was changed last", frame.input.can_undo},
                                {"Redo", "Redo", Action::redo, "What was undone last", frame.input.can_redo},
                                {"Fit", "Fit", Action::fit, "Shows the whole domain"},
                                {"Copy command", "Copy command", Action::copy_command,
                                 "The command line that makes this picture, to the clipboard"}};
  const ActionButton second[] = {{"PNG", "PNG", Action::save_png, "The picture, without the panel"},
                                 {"SVG", "SVG", Action::save_svg, "The picture as polygons and lines"},
                                 {"Save sites", "Sites", Action::save_sites, "The sites, as .csv"}};
  drawButtons(frame, first);
  frame.widgets.row("Save");
  drawButtons(frame, second);
}

void drawCell(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  const std::optional<Hovered>& cell = frame.input.hovered;
  if (!widgets.group("Cell")) return;
  // The number of rows is the same with and without a cell, so that nothing below moves.
  const auto pair = [&](const char* label, const std::string& text, float left, float value) {
    ImGui::SetCursorPosX(ImGui::GetStyle().WindowPadding.x + widgets.px(left));
    Widgets::dim(label);
    ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + widgets.px(value));
    ImGui::TextUnformatted(cell ? text.c_str() : "\u2013");
    widgets.note(std::string("Cell/") + label);
  };
  const Hovered shown = cell.value_or(Hovered{});
  pair("site", fmt::format("{}", shown.site), 0, 42);
  ImGui::SameLine();
  pair("neighbors", fmt::format("{}", shown.neighbors), 114, 176);
  pair("area", fmt::format("{:.4g}", shown.area), 0, 42);
  ImGui::SameLine();
  pair("weight", fmt::format("{:.4g}", shown.weight), 114, 176);
  pair("place", fmt::format("{:.6g}, {:.6g}", shown.position.x, shown.position.y), 0, 42);
}

void drawShow(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  Settings& settings = frame.result.settings;
  RenderOptions& picture = settings.picture;
  if (!widgets.group("Show")) return;
  const float third = Widgets::share(3);
  widgets.toggle("Cells", third, settings.cells);
  ImGui::SameLine();
  widgets.toggle("Edges", third, picture.edges);
  ImGui::SameLine();
  widgets.toggle("Sites", Widgets::share(1), picture.show_sites);
  widgets.toggle("Dual", third, picture.dual);
  widgets.tooltip(
      "Lines between the sites of neighbors: those of the Delaunay triangulation that meet in the domain");
  ImGui::SameLine();
  widgets.toggle("Labels", third, picture.labels);
  widgets.tooltip("The number of each site, where there is room for it");
  ImGui::SameLine();
  const bool by_site = !colorsHaveKey(picture.color);
  const bool by_flow = frame.input.fluid && settings.flow_color != FlowColor::none;
  widgets.toggle("Legend", Widgets::share(1), picture.legend, !by_site && !by_flow && settings.cells);
  if (!settings.cells) {
    widgets.tooltip("White cells have no colors to explain");
  } else if (by_flow) {
    widgets.tooltip("Colors by density and speed have no legend");
  } else if (by_site) {
    widgets.tooltip("Colors by site stand for nothing");
  }
  drawSizes(widgets, picture);
  widgets.row("Antialias");
  std::vector<int> counts{1, 2, 4, 8};
  auto entry = std::lower_bound(counts.begin(), counts.end(), picture.antialias);
  if (entry == counts.end() || *entry != picture.antialias) entry = counts.insert(entry, picture.antialias);
  std::vector<std::string> labels;
  for (const int count : counts) labels.push_back(count == 1 ? "off" : fmt::format("{0}\u00d7{0}", count));
  const int chosen = widgets.choice("Antialias", labels, static_cast<int>(entry - counts.begin()));
  if (chosen >= 0) picture.antialias = counts[static_cast<std::size_t>(chosen)];
}

void drawColor(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  RenderOptions& picture = frame.result.settings.picture;
  if (!widgets.group("Color")) return;
  FlowColor& flow = frame.result.settings.flow_color;
  const bool by_flow = frame.input.fluid && flow != FlowColor::none;
  const int color =
      widgets.choice("Color", namesFrom<ColorBy>(), by_flow ? -1 : static_cast<int>(picture.color));
  if (color >= 0) colorBy(static_cast<ColorBy>(color), frame.result.settings);
  if (frame.input.fluid) {
    widgets.row("Fluid");
    const int by = widgets.choice("Flow", flow_names, static_cast<int>(flow));
    if (by >= 0) flow = static_cast<FlowColor>(by);
    widgets.tooltip("Colors by what flows, in place of those above");
  }
  const bool by_site = !colorsHaveKey(picture.color) && !by_flow;
  widgets.row("Scale");
  const int scale = widgets.choice("Scale", scale_choices, static_cast<int>(picture.color_scale), !by_site);
  if (scale >= 0) picture.color_scale = static_cast<ColorScale>(scale);
  widgets.row("Colors");
  drawMaps(widgets, picture);
}

}  // namespace vorpipe::view
