#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "view/groups.h"
#include "view/style.h"

namespace vorpipe::view {

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
  pair("place", fmt::format("{:.6g}, {:.6g}", shown.place.x, shown.place.y), 0, 42);
}

namespace {

void drawSizes(Widgets& widgets, RenderOptions& picture) {
  if (picture.edges) {
    widgets.row("Edges");
    widgets.slider("Edge width", picture.edge_width, 1, 10, "%.1f px");
  }
  if (picture.show_sites) {
    widgets.row("Sites");
    widgets.slider("Site size", picture.dot_size, 0, 30,
                   picture.dot_size > 0 ? "%.1f px" : "by their spacing");
  }
  if (picture.labels) {
    widgets.row("Labels");
    widgets.slider("Label size", picture.label_size, 5, 40, "%.0f px");
  }
}

}  // namespace

void drawShow(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  Settings& settings = frame.answer.settings;
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
  const bool by_site = picture.color == ColorBy::site;
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
  auto place = std::lower_bound(counts.begin(), counts.end(), picture.antialias);
  if (place == counts.end() || *place != picture.antialias) place = counts.insert(place, picture.antialias);
  std::vector<std::string> labels;
  for (const int count : counts) labels.push_back(count == 1 ? "off" : fmt::format("{0}\u00d7{0}", count));
  const int chosen = widgets.choice("Antialias", labels, static_cast<int>(place - counts.begin()));
  if (chosen >= 0) picture.antialias = counts[static_cast<std::size_t>(chosen)];
}

}  // namespace vorpipe::view
