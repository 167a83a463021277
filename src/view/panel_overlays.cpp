// What the panel draws outside its window: tooltip, help, message, the line of a comparison, the brush.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "view/widgets.h"

namespace vorpipe::view {
namespace {

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing;

}  // namespace

std::pair<float, float> freeOf(const PanelFrame& frame) {
  float left = 0, right = static_cast<float>(frame.input.width);
  if (const auto panel = frame.widgets.placements.find("Panel"); panel != frame.widgets.placements.end()) {
    const auto begin = static_cast<float>(panel->second.left);
    const float end = begin + static_cast<float>(panel->second.width);
    (begin > right - end ? right : left) = begin > right - end ? begin : end;
  }
  return {left, right};
}

void drawTip(PanelFrame& frame) {
  const std::optional<Hovered>& cell = frame.input.hovered;
  if (!cell || !ImGui::IsMousePosValid()) return;
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(fmt::format("site {}", cell->site).c_str());
  Widgets::dim(fmt::format("area {:.4g}\n{} neighbors", cell->area, cell->neighbors));
  if (cell->weight != 0) Widgets::dim(fmt::format("weight {:.4g}", cell->weight));
  ImGui::EndTooltip();
}

void drawHelp(PanelFrame& frame) {
  Widgets& widgets = frame.widgets;
  const PanelInput& input = frame.input;
  const ImVec2 window{static_cast<float>(input.width), static_cast<float>(input.height)};
  const ImVec2 padding{widgets.px(18), widgets.px(12)};
  const float cap = widgets.px(6), side = ImGui::GetFrameHeight();
  float keys = 0, meanings = widgets.px(160);
  for (const auto& [key, meaning] : input.keys) {
    keys = std::max(keys, ImGui::CalcTextSize(key.c_str()).x);
    meanings = std::max(meanings, ImGui::CalcTextSize(meaning.c_str()).x);
  }
  const float second = padding.x + keys + 2 * cap + widgets.px(14), right = second + meanings;
  // Beside the panel, or over it if there is no room.
  const auto [from, to] = freeOf(frame);
  const bool beside = right + padding.x + ImGui::GetStyle().ScrollbarSize <= to - from;
  ImGui::SetNextWindowPos({std::round(beside ? (from + to) / 2 : window.x / 2), std::round(window.y / 2)},
                          ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x - widgets.px(20), window.y - widgets.px(20)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::Begin("##help", nullptr, fixed & ~ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleVar();
  widgets.cover();
  widgets.placements.insert_or_assign("Keys", widgets.covered.back());
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Keys and pointer");
  ImGui::SameLine(right - side);
  if (widgets.button("Close help", "\u00d7", side)) frame.result.settings.help = false;
  ImGui::Separator();
  ImGui::Dummy({0, 1});
  // Lines are spaced more tightly before they need scrolling.
  const float room = window.y - widgets.px(20) - padding.y - ImGui::GetCursorPosY();
  const float between =
      room / static_cast<float>(std::max<std::size_t>(1, input.keys.size())) - ImGui::GetTextLineHeight();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                      ImVec2{0, std::clamp(std::floor(between), widgets.px(1), widgets.px(5))});
  for (const auto& [key, meaning] : input.keys) {
    const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::CalcTextSize(key.c_str());
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y - 1},
                                              {at.x + size.x + 2 * cap, at.y + size.y + widgets.px(2)},
                                              look::field, ImGui::GetStyle().FrameRounding);
    ImGui::SetCursorPosX(padding.x + cap);
    ImGui::TextUnformatted(key.c_str());
    ImGui::SameLine(second);
    Widgets::dim(meaning);
    widgets.note("Keys/" + key);
  }
  ImGui::PopStyleVar();
  ImGui::End();
}

void drawSplit(const PanelFrame& frame) {
  const PanelInput& input = frame.input;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float at = std::round(static_cast<float>(frame.result.settings.split * input.width));
  const auto bottom = static_cast<float>(input.height);
  const float half = frame.widgets.px(1), pad = frame.widgets.px(8), line = ImGui::GetTextLineHeight();
  list.AddRectFilled({at - half, 0}, {at + half, bottom}, look::accent);
  const auto name = [&](const std::string& text, float left) {
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    list.AddRectFilled({left - pad / 2, bottom - line - 1.5F * pad},
                       {left + width + pad / 2, bottom - pad / 2}, look::surface,
                       ImGui::GetStyle().FrameRounding);
    list.AddText({left, bottom - line - pad}, look::text, text.c_str());
  };
  name(input.computed_by, std::round(at - 2 * pad - ImGui::CalcTextSize(input.computed_by.c_str()).x));
  name(input.compared->by, at + 2 * pad);
}

void drawBrush(const PanelFrame& frame) {
  const BrushShown& brush = *frame.input.fluid->brush;
  const ImVec2 middle{static_cast<float>(brush.middle.x), static_cast<float>(brush.middle.y)};
  const auto radius = static_cast<float>(brush.radius);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddCircle(middle, radius, IM_COL32(0, 0, 0, 150), 0, frame.widgets.px(3));
  list.AddCircle(middle, radius, IM_COL32(255, 255, 255, 220), 0, frame.widgets.px(1));
}

void drawBorder(const PanelFrame& frame) {
  const std::optional<Hovered>& cell = frame.input.hovered;
  if (!cell || cell->border.empty() || !ImGui::IsMousePosValid()) return;
  std::vector<ImVec2> line;
  line.reserve(cell->border.size());
  for (const Position& at : cell->border) {
    line.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y));
  }
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto count = static_cast<int>(line.size());
  // Seen on any color.
  list.AddPolyline(line.data(), count, IM_COL32(0, 0, 0, 160), ImDrawFlags_Closed, frame.widgets.px(4));
  list.AddPolyline(line.data(), count, IM_COL32(255, 255, 255, 235), ImDrawFlags_Closed, frame.widgets.px(2));
}

void drawMessage(PanelFrame& frame, const std::string& message, float shows) {
  Widgets& widgets = frame.widgets;
  const PanelInput& input = frame.input;
  const float margin = widgets.px(10), pad = widgets.px(12);
  const auto [left, right] = freeOf(frame);
  const float room = std::max(widgets.px(80), right - left - 2 * margin);
  ImGui::SetNextWindowPos({std::round((left + right) / 2), static_cast<float>(input.height) - margin},
                          ImGuiCond_Always, {0.5F, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, shows);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2{pad, widgets.px(6)});
  ImGui::Begin("##message", nullptr, fixed | ImGuiWindowFlags_NoInputs);
  ImGui::PopStyleVar();
  ImGui::PushTextWrapPos(room - pad);
  ImGui::TextUnformatted(message.c_str());
  ImGui::PopTextWrapPos();
  widgets.note("Message");
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace vorpipe::view
