#include "view/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace vorpipe::view {
namespace {

constexpr float label_column = 74;

Placement placementOf(ImVec2 from, ImVec2 to) {
  return {double{from.x}, double{from.y}, double{to.x} - double{from.x}, double{to.y} - double{from.y}};
}

const char* endOf(std::string_view text) { return text.data() + text.size(); }

void setColors(ImGuiStyle& style) {
  constexpr auto colors = std::to_array<std::pair<ImGuiCol, ImU32>>({
      {ImGuiCol_Text, look::text},
      {ImGuiCol_TextDisabled, look::dim},
      {ImGuiCol_WindowBg, look::surface},
      {ImGuiCol_PopupBg, IM_COL32(38, 42, 49, 252)},
      {ImGuiCol_Border, look::line},
      {ImGuiCol_FrameBg, look::field},
      {ImGuiCol_FrameBgHovered, look::field_hovered},
      {ImGuiCol_FrameBgActive, look::field_hovered},
      {ImGuiCol_Button, look::field},
      {ImGuiCol_ButtonHovered, look::field_hovered},
      {ImGuiCol_ButtonActive, look::field_hovered},
      {ImGuiCol_SliderGrab, look::accent},
      {ImGuiCol_SliderGrabActive, look::accent_hovered},
      {ImGuiCol_Header, IM_COL32(46, 51, 60, 255)},
      {ImGuiCol_HeaderHovered, look::field_hovered},
      {ImGuiCol_HeaderActive, look::field_hovered},
      {ImGuiCol_Separator, look::line},
      {ImGuiCol_ScrollbarBg, IM_COL32(0, 0, 0, 0)},
      {ImGuiCol_ScrollbarGrab, IM_COL32(72, 78, 90, 255)},
      {ImGuiCol_ScrollbarGrabHovered, IM_COL32(90, 97, 110, 255)},
      {ImGuiCol_ScrollbarGrabActive, look::accent},
      {ImGuiCol_TextSelectedBg, IM_COL32(74, 144, 217, 110)},
  });
  for (const auto& [which, color] : colors) style.Colors[which] = ImGui::ColorConvertU32ToFloat4(color);
}

}  // namespace

void setStyle(double scale) {
  ImGuiStyle style;
  setColors(style);
  style.WindowPadding = {12, 10};
  style.FramePadding = {7, 3};
  style.ItemSpacing = {6, 4};
  style.ItemInnerSpacing = {5, 4};
  style.WindowRounding = 8;
  style.PopupRounding = 6;
  style.FrameRounding = 4;
  style.GrabRounding = 3;
  style.GrabMinSize = 10;
  style.ScrollbarSize = 9;
  style.ScrollbarRounding = 4;
  style.WindowBorderSize = 1;
  style.PopupBorderSize = 1;
  style.DisabledAlpha = 0.45F;
  style.WindowMinSize = {16, 16};
  style.ScaleAllSizes(static_cast<float>(scale));
  ImGui::GetStyle() = style;
}

float Widgets::px(float units) const { return std::round(units * scale_); }

void Widgets::note(std::string_view name) {
  placements.insert_or_assign(std::string(name),
                              placementOf(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()));
}

void Widgets::cover() {
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  covered.push_back(placementOf(from, {from.x + size.x, from.y + size.y}));
}

bool Widgets::group(const char* name, std::string_view summary) {
  ImGui::Dummy({0, px(1)});
  bool& open = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID(name), true);
  const float height = ImGui::GetTextLineHeight() + px(4), width = ImGui::GetContentRegionAvail().x;
  ImGui::PushID(name);
  if (ImGui::InvisibleButton("##group", {width, height})) open = !open;
  ImGui::PopID();
  note(name);
  const ImVec2 at = ImGui::GetItemRectMin();
  const ImU32 color = ImGui::IsItemHovered() ? look::on_accent : look::heading;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float side = px(3), middle = at.y + height / 2, text = at.x + px(13), top = at.y + px(2);
  if (open) {
    list.AddTriangleFilled({at.x, middle - side / 2}, {at.x + 2 * side, middle - side / 2},
                           {at.x + side, middle + side}, color);
  } else {
    list.AddTriangleFilled({at.x + side / 2, middle - side}, {at.x + 2 * side, middle},
                           {at.x + side / 2, middle + side}, color);
  }
  list.AddText({text, top}, color, name);
  const float right = at.x + width - ImGui::CalcTextSize(summary.data(), endOf(summary)).x;
  list.AddText({right, top}, look::dim, summary.data(), endOf(summary));
  const float line = std::round(middle);
  list.AddLine({text + ImGui::CalcTextSize(name).x + px(7), line},
               {summary.empty() ? right : right - px(7), line}, look::line);
  return open;
}

void Widgets::row(const char* label) {
  ImGui::AlignTextToFramePadding();
  dim(label);
  ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + px(label_column));
}

void Widgets::value(std::string_view text, ImU32 color) {
  const float room = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const auto wide = [](std::string_view of) { return ImGui::CalcTextSize(of.data(), endOf(of)).x; };
  std::string shown(text);
  for (std::size_t kept = text.size(); kept > 0 && wide(shown) > room;) {
    // Does not cut within a UTF-8 character.
    do --kept;
    while (kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xC0U) == 0x80U);
    shown = std::string(text.substr(0, kept)) + "\u2026";
  }
  ImGui::Dummy({std::min(wide(shown), room), ImGui::GetFrameHeight()});
  ImGui::GetWindowDrawList()->AddText({at.x, at.y + ImGui::GetStyle().FramePadding.y}, color, shown.c_str());
  if (shown != text) tooltip(text);
}

void Widgets::dim(std::string_view text) {
  ImGui::PushStyleColor(ImGuiCol_Text, look::dim);
  ImGui::TextUnformatted(text.data(), endOf(text));
  ImGui::PopStyleColor();
}

ImVec2 Widgets::chart(float width, float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height}, IM_COL32(22, 24, 29, 255),
                                            ImGui::GetStyle().FrameRounding);
  return at;
}

void Widgets::tooltip(std::string_view text) const {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(px(320));
  ImGui::TextUnformatted(text.data(), endOf(text));
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool Widgets::pressable(std::string_view name, const char* label, ImVec2 size, bool on, bool enabled,
                        ImDrawFlags corners) {
  ImGui::PushID(name.data(), endOf(name));
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::InvisibleButton("", size);
  const bool hovered = enabled && ImGui::IsItemHovered();
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const ImU32 lit = hovered ? look::accent_hovered : look::accent;
  const ImU32 unlit = hovered ? look::field_hovered : look::field;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto faded = [](ImU32 color) { return ImGui::GetColorU32(ImGui::ColorConvertU32ToFloat4(color)); };
  list.AddRectFilled(from, to, faded(on ? lit : unlit), ImGui::GetStyle().FrameRounding, corners);
  const ImVec2 text = ImGui::CalcTextSize(label);
  const ImVec4 clip{from.x, from.y, to.x, to.y};
  list.AddText(nullptr, 0,
               {std::round(std::max(from.x + px(3), (from.x + to.x - text.x) / 2)),
                std::round((from.y + to.y - text.y) / 2)},
               faded(on ? look::on_accent : look::text), label, nullptr, 0, &clip);
  ImGui::EndDisabled();
  ImGui::PopID();
  note(name);
  return pressed;
}

bool Widgets::button(std::string_view name, const char* label, float width, bool enabled) {
  return chip(name, label, width, false, enabled);
}

bool Widgets::chip(std::string_view name, const char* label, float width, bool on, bool enabled) {
  return pressable(name, label, {width, ImGui::GetFrameHeight()}, on, enabled, ImDrawFlags_RoundCornersAll);
}

void Widgets::toggle(const char* name, float width, bool& on, bool enabled) {
  if (chip(name, name, width, on, enabled)) on = !on;
}

int Widgets::choice(std::string_view name, std::span<const std::string> labels, int current, bool enabled,
                    float width) {
  const auto count = static_cast<int>(labels.size());
  // Segments are as wide as their labels, and share the remaining width.
  float asked = 0;
  for (const std::string& label : labels) asked += ImGui::CalcTextSize(label.c_str()).x;
  const float gap = 1, whole = width > 0 ? width : ImGui::GetContentRegionAvail().x;
  const float room = whole - gap * static_cast<float>(count - 1);
  const float more = (room - asked) / static_cast<float>(count);
  const float begin = ImGui::GetCursorScreenPos().x;
  float right = 0;
  int chosen = -1;
  for (int i = 0; i < count; ++i) {
    const std::string& label = labels[static_cast<std::size_t>(i)];
    const float left = right;
    right += ImGui::CalcTextSize(label.c_str()).x + more;
    const float part = std::max(1.0F, std::round(begin + right) - std::round(begin + left));
    ImDrawFlags corners = ImDrawFlags_RoundCornersNone;
    if (i == 0) corners = count == 1 ? ImDrawFlags_RoundCornersAll : ImDrawFlags_RoundCornersLeft;
    if (i > 0 && i + 1 == count) corners = ImDrawFlags_RoundCornersRight;
    if (i > 0) ImGui::SameLine(0, gap);
    if (pressable(fmt::format("{}/{}", name, label), label.c_str(), {part, ImGui::GetFrameHeight()},
                  i == current, enabled, corners)) {
      chosen = i;
    }
  }
  return chosen;
}

bool Widgets::slider(const char* label, std::string_view name, double& value, double least, double most,
                     const char* format) {
  row(label);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  const std::string id = fmt::format("##{}", name);
  const bool changed = ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &least, &most, format,
                                           ImGuiSliderFlags_AlwaysClamp);
  note(name);
  return changed;
}

bool Widgets::beginList(std::string_view name, const char* preview) {
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float width = ImGui::CalcItemWidth();
  placements.insert_or_assign(std::string(name),
                              placementOf(from, {from.x + width, from.y + ImGui::GetFrameHeight()}));
  if (!ImGui::BeginCombo(fmt::format("##{}", name).c_str(), preview, ImGuiComboFlags_HeightLarge))
    return false;
  cover();
  if (closes_list) ImGui::CloseCurrentPopup();
  return true;
}

void Widgets::endList() { ImGui::EndCombo(); }

bool Widgets::item(std::string_view name, const char* label, bool current, bool enabled) {
  ImGui::PushID(name.data(), endOf(name));
  const bool chosen = ImGui::Selectable(label, current, enabled ? 0 : ImGuiSelectableFlags_Disabled);
  ImGui::PopID();
  note(name);
  return chosen;
}

float Widgets::share(int count) {
  const float room = ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  return std::floor((room - gap * static_cast<float>(count - 1)) / static_cast<float>(count));
}

}  // namespace vorpipe::view
